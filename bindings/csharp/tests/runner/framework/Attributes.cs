// The attributes that mark tests, by their NUnit names. The tests compile against NUnit 2.6 and 3 as well.
using System;

namespace NUnit.Framework
{
    /// <summary>A class with tests. One object serves all of its tests.</summary>
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class TestFixtureAttribute : Attribute { }

    /// <summary>A test: a public method that returns void and has no parameters.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TestAttribute : Attribute { }

    /// <summary>A test with arguments: one test for each attribute.</summary>
    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public sealed class TestCaseAttribute : Attribute
    {
        public TestCaseAttribute(params object[] arguments)
        {
            Arguments = arguments ?? new object[] { null };
        }

        public object[] Arguments { get; }
    }

    /// <summary>Runs before each test; those of base classes run first.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class SetUpAttribute : Attribute { }

    /// <summary>Runs after each test, also after a failed SetUp; those of base classes run last.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TearDownAttribute : Attribute { }

    /// <summary>Skips a test or a fixture.</summary>
    [AttributeUsage(AttributeTargets.Class | AttributeTargets.Method)]
    public sealed class IgnoreAttribute : Attribute
    {
        public IgnoreAttribute(string reason)
        {
            Reason = reason;
        }

        public string Reason { get; }
    }
}
