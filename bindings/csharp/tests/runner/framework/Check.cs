// A condition on a value, with the words for "expected"; constraints and asserts are made of these.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;

namespace NUnit.Framework
{
    internal sealed class Check
    {
        private readonly Predicate<object> holds;
        private readonly string expected;
        private readonly Func<object, string> detail;

        internal Check(string expected, Predicate<object> holds, Func<object, string> detail = null)
        {
            this.expected = expected;
            this.holds = holds;
            this.detail = detail;
        }

        /// <summary>Throws AssertionException with what was expected and what the value is.</summary>
        internal void Apply(object actual, string message)
        {
            if (holds(actual)) return;
            string more = detail == null ? "" : detail(actual);
            Fail(message, expected, Text.Of(actual), string.IsNullOrEmpty(more) ? "" : "\n" + more);
        }

        internal static void Fail(string message, string expected, string was, string more = "")
        {
            string head = string.IsNullOrEmpty(message) ? "" : message + "\n";
            throw new AssertionException(head + "expected: " + expected + "\nwas:      " + was + more);
        }

        internal static Check Not(Check c)
        {
            return new Check("not " + c.expected, v => !c.holds(v));
        }

        internal static Check Both(Check a, Check b)
        {
            return new Check(a.expected + " and " + b.expected, v => a.holds(v) && b.holds(v));
        }

        internal static Check Either(Check a, Check b)
        {
            return new Check(a.expected + " or " + b.expected, v => a.holds(v) || b.holds(v));
        }

        internal static Check All(Check c)
        {
            return new Check("all items " + c.expected, v => Items(v).All(i => c.holds(i)), v =>
            {
                int at = Items(v).TakeWhile(i => c.holds(i)).Count();
                return "item " + at + " is " + Text.Of(Items(v).ElementAt(at));
            });
        }

        internal static Check Property(string name, Check c)
        {
            Func<object, object> value = owner =>
            {
                PropertyInfo property = owner == null ? null : owner.GetType().GetProperty(name);
                if (property == null) throw new ArgumentException("no " + name + " in " + Text.Of(owner));
                return property.GetValue(owner, null);
            };
            return new Check(name + " " + c.expected, v => c.holds(value(v)),
                             v => name + " is " + Text.Of(value(v)));
        }

        internal static Check Equal(object expected)
        {
            return new Check(Text.Of(expected), v => Compare.Difference(expected, v) == null,
                             v => Compare.Difference(expected, v));
        }

        internal static Check Null()
        {
            return new Check("null", v => v == null);
        }

        internal static Check Same(object expected)
        {
            return new Check("same object as " + Text.Of(expected), v => ReferenceEquals(expected, v));
        }

        internal static Check Greater(object bound)
        {
            return new Check("greater than " + Text.Of(bound), v => Compare.Order(v, bound) > 0);
        }

        internal static Check AtLeast(object bound)
        {
            return new Check("at least " + Text.Of(bound), v => Compare.Order(v, bound) >= 0);
        }

        internal static Check Less(object bound)
        {
            return new Check("less than " + Text.Of(bound), v => Compare.Order(v, bound) < 0);
        }

        internal static Check AtMost(object bound)
        {
            return new Check("at most " + Text.Of(bound), v => Compare.Order(v, bound) <= 0);
        }

        internal static Check InRange(object from, object to)
        {
            return new Check("in range [" + Text.Of(from) + ", " + Text.Of(to) + "]",
                             v => Compare.Order(v, from) >= 0 && Compare.Order(v, to) <= 0);
        }

        internal static Check Empty()
        {
            return new Check("empty", v => !Items(v).Any());
        }

        internal static Check Member(object item)
        {
            return new Check("a sequence with item " + Text.Of(item),
                             v => Items(v).Any(i => Compare.Difference(item, i) == null));
        }

        internal static Check Ordered(bool descending)
        {
            return new Check(descending ? "in descending order" : "in ascending order", v =>
            {
                object[] items = Items(v).ToArray();
                for (int i = 1; i < items.Length; i++)
                {
                    int? order = Compare.Order(items[i - 1], items[i]);
                    if (!(descending ? order >= 0 : order <= 0)) return false;
                }
                return true;
            });
        }

        internal static Check InstanceOf(Type type)
        {
            return new Check("an instance of " + type.FullName, type.IsInstanceOfType,
                             v => "of type " + (v == null ? "null" : v.GetType().FullName));
        }

        private static IEnumerable<object> Items(object value)
        {
            if (value is IEnumerable sequence) return sequence.Cast<object>();
            throw new ArgumentException("no sequence: " + Text.Of(value));
        }
    }
}
