// The assertions that the tests use, with NUnit's names and order of arguments.
using System;

namespace NUnit.Framework
{
    public static class Assert
    {
        public static void That(bool condition, string message = null)
        {
            new Check("true", v => (bool)v).Apply(condition, message);
        }

        public static void That(object actual, Constraint constraint, string message = null)
        {
            constraint.Whole.Apply(actual, message);
        }

        public static void IsTrue(bool condition, string message = null)
        {
            That(condition, message);
        }

        public static void IsFalse(bool condition, string message = null)
        {
            new Check("false", v => !(bool)v).Apply(condition, message);
        }

        public static void IsNull(object value, string message = null)
        {
            Check.Null().Apply(value, message);
        }

        public static void IsNotNull(object value, string message = null)
        {
            Check.Not(Check.Null()).Apply(value, message);
        }

        public static void AreEqual(object expected, object actual, string message = null)
        {
            Check.Equal(expected).Apply(actual, message);
        }

        public static void AreEqual(double expected, double actual, double delta, string message = null)
        {
            string words = Text.Of(expected) + " +- " + Text.Of(delta);
            new Check(words, v => Compare.Within(expected, (double)v, delta)).Apply(actual, message);
        }

        public static void AreNotEqual(object expected, object actual, string message = null)
        {
            Check.Not(Check.Equal(expected)).Apply(actual, message);
        }

        public static void AreNotSame(object expected, object actual, string message = null)
        {
            Check.Not(Check.Same(expected)).Apply(actual, message);
        }

        public static void Greater(IComparable value, IComparable bound, string message = null)
        {
            Check.Greater(bound).Apply(value, message);
        }

        public static void GreaterOrEqual(IComparable value, IComparable bound, string message = null)
        {
            Check.AtLeast(bound).Apply(value, message);
        }

        public static void Less(IComparable value, IComparable bound, string message = null)
        {
            Check.Less(bound).Apply(value, message);
        }

        public static void LessOrEqual(IComparable value, IComparable bound, string message = null)
        {
            Check.AtMost(bound).Apply(value, message);
        }

        /// <summary>Returns the exception, whose type must be T itself, not one derived from it.</summary>
        public static T Throws<T>(TestDelegate call, string message = null) where T : Exception
        {
            Exception caught = null;
            try
            {
                call();
            }
            catch (Exception error)
            {
                caught = error;
            }
            if (caught != null && caught.GetType() == typeof(T)) return (T)caught;
            string was = caught == null ? "nothing thrown" : Failure.Describe(caught);
            Check.Fail(message, typeof(T).FullName + " thrown", was);
            return null;
        }

        public static void Fail(string message)
        {
            throw new AssertionException(message);
        }

        /// <summary>Skips the test that runs.</summary>
        public static void Ignore(string reason)
        {
            throw new IgnoreException(reason);
        }
    }
}
