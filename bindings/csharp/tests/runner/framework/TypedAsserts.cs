// Assertions on sequences and strings.
using System.Collections;

namespace NUnit.Framework
{
    public static class CollectionAssert
    {
        public static void AreEqual(IEnumerable expected, IEnumerable actual, string message = null)
        {
            Check.Equal(expected).Apply(actual, message);
        }
    }

    public static class StringAssert
    {
        public static void Contains(string expected, string actual, string message = null)
        {
            Containing(expected).Apply(actual, message);
        }

        public static void DoesNotContain(string expected, string actual, string message = null)
        {
            Check.Not(Containing(expected)).Apply(actual, message);
        }

        public static void StartsWith(string expected, string actual, string message = null)
        {
            new Check("a text that starts with " + Text.Of(expected),
                      v => v != null && ((string)v).StartsWith(expected, System.StringComparison.Ordinal))
                .Apply(actual, message);
        }

        private static Check Containing(string part)
        {
            return new Check("a text with " + Text.Of(part), v => v != null && ((string)v).Contains(part));
        }
    }
}
