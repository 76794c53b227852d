// Equality and order as NUnit defines them: numbers by value over all types, sequences item by item.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Linq;

namespace NUnit.Framework
{
    internal static class Compare
    {
        /// <summary>Null if equal, else where they differ, or "" if the values say it themselves.</summary>
        internal static string Difference(object expected, object actual)
        {
            if (expected == null || actual == null) return ReferenceEquals(expected, actual) ? null : "";
            if (IsNumber(expected) && IsNumber(actual)) return SameNumber(expected, actual) ? null : "";
            if (expected is string a && actual is string b) return StringDifference(a, b);
            if (expected is IEnumerable left && actual is IEnumerable right)
                return SequenceDifference(left, right);
            return expected.Equals(actual) ? null : "";
        }

        internal static bool Within(double expected, double actual, double delta)
        {
            bool finite = !double.IsNaN(expected) && !double.IsInfinity(expected);
            return finite ? Math.Abs(expected - actual) <= delta : expected.Equals(actual);
        }

        /// <summary>
        /// Negative if a is before b, 0 if equal, positive if after, and null if one is NaN: NaN is in no
        /// range. NUnit 2.6 takes NaN for less than all numbers.
        /// </summary>
        internal static int? Order(object a, object b)
        {
            if (!IsNumber(a) || !IsNumber(b)) return Comparer.Default.Compare(a, b);
            if (!IsReal(a) && !IsReal(b)) return Convert.ToDecimal(a).CompareTo(Convert.ToDecimal(b));
            double left = Convert.ToDouble(a), right = Convert.ToDouble(b);
            if (double.IsNaN(left) || double.IsNaN(right)) return null;
            return left.CompareTo(right);
        }

        private static bool SameNumber(object a, object b)
        {
            if (IsReal(a) || IsReal(b)) return Convert.ToDouble(a).Equals(Convert.ToDouble(b));
            return Order(a, b) == 0;
        }

        private static bool IsReal(object value)
        {
            return value is float || value is double;
        }

        /// <summary>Enumerators and characters are no numbers.</summary>
        private static bool IsNumber(object value)
        {
            return IsReal(value) || value is decimal || value is sbyte || value is byte || value is short ||
                   value is ushort || value is int || value is uint || value is long || value is ulong;
        }

        private static string StringDifference(string expected, string actual)
        {
            if (expected == actual) return null;
            int i = 0;
            while (i < expected.Length && i < actual.Length && expected[i] == actual[i]) i++;
            return "they differ from character " + i + " on";
        }

        private static string SequenceDifference(IEnumerable expected, IEnumerable actual)
        {
            if (expected is Array a && actual is Array b && !Shape(a).SequenceEqual(Shape(b)))
                return "lengths: expected " + Text.Of(Shape(a)) + ", was " + Text.Of(Shape(b));
            List<object> left = expected.Cast<object>().ToList(), right = actual.Cast<object>().ToList();
            for (int i = 0; i < left.Count && i < right.Count; i++)
                if (Difference(left[i], right[i]) != null)
                    return "item " + i + ": expected " + Text.Of(left[i]) + ", was " + Text.Of(right[i]);
            if (left.Count == right.Count) return null;
            return "lengths: expected " + left.Count + ", was " + right.Count;
        }

        private static int[] Shape(Array array)
        {
            return Enumerable.Range(0, array.Rank).Select(array.GetLength).ToArray();
        }
    }
}
