// What ends a test early: a failed assertion, or the test's wish to be skipped.
using System;

namespace NUnit.Framework
{
    public delegate void TestDelegate();

    [Serializable]
    public class AssertionException : Exception
    {
        public AssertionException(string message) : base(message) { }
    }

    [Serializable]
    public class IgnoreException : Exception
    {
        public IgnoreException(string message) : base(message) { }
    }
}
