using System.Runtime.CompilerServices;

// The tests hand foreign and stale ids to the library, which the classes do not let through.
[assembly: InternalsVisibleTo("Vfit.Tests")]
