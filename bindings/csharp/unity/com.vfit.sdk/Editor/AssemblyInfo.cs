using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Vfit.Unity.Tests")]
