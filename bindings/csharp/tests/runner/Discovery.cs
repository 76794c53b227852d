// Finds the fixtures of an assembly, their tests, and their SetUp and TearDown methods, in running order.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using NUnit.Framework;

namespace Vfit.TestRunner
{
    /// <summary>A method with the arguments of one of its TestCase attributes.</summary>
    internal sealed class Case
    {
        internal string Name;
        internal MethodInfo Method;
        internal object[] Arguments;
    }

    internal static class Discovery
    {
        private const BindingFlags Any =
            BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;

        /// <summary>Classes with tests of their own or inherited ones, by name; no abstract ones.</summary>
        internal static Type[] Fixtures(Assembly assembly)
        {
            // A static class is abstract and sealed.
            return assembly.GetTypes()
                .Where(t => t.IsClass && (!t.IsAbstract || t.IsSealed) && Cases(t).Length > 0)
                .OrderBy(t => t.FullName, StringComparer.InvariantCulture).ToArray();
        }

        /// <summary>The tests of a fixture by name, also those that cannot run (see FaultOf).</summary>
        internal static Case[] Cases(Type fixture)
        {
            return Hierarchy(fixture).SelectMany(m => CasesOf(fixture, m))
                .OrderBy(c => c.Name, StringComparer.InvariantCulture).ToArray();
        }

        /// <summary>Methods with the attribute, those of base classes first.</summary>
        internal static MethodInfo[] Marked<T>(Type fixture) where T : Attribute
        {
            return Hierarchy(fixture).Where(m => m.IsDefined(typeof(T), true)).ToArray();
        }

        internal static string IgnoreReason(MemberInfo member)
        {
            object[] found = member.GetCustomAttributes(typeof(IgnoreAttribute), true);
            return found.Length == 0 ? null : ((IgnoreAttribute)found[0]).Reason;
        }

        /// <summary>Why a method cannot run as a test, SetUp or TearDown, or null.</summary>
        internal static string FaultOf(MethodInfo method, object[] arguments)
        {
            if (!method.IsPublic) return "is not public";
            if (method.ReturnType != typeof(void)) return "does not return void";
            if (method.IsAbstract || method.ContainsGenericParameters) return "is abstract or generic";
            int wanted = method.GetParameters().Length;
            if (wanted == arguments.Length) return null;
            return "takes " + wanted + " arguments and gets " + arguments.Length;
        }

        private static IEnumerable<Case> CasesOf(Type fixture, MethodInfo method)
        {
            string name = fixture.FullName + "." + method.Name;
            foreach (TestCaseAttribute row in method.GetCustomAttributes(typeof(TestCaseAttribute), true))
            {
                string full = name + "(" + string.Join(", ", row.Arguments.Select(Text.Of).ToArray()) + ")";
                yield return new Case { Name = full, Method = method, Arguments = row.Arguments };
            }
            bool withoutCases = !method.IsDefined(typeof(TestCaseAttribute), true);
            if (withoutCases && method.IsDefined(typeof(TestAttribute), true))
                yield return new Case { Name = name, Method = method, Arguments = new object[0] };
        }

        /// <summary>Methods from the base class down, private ones too; overrides replace bases.</summary>
        private static IEnumerable<MethodInfo> Hierarchy(Type type)
        {
            var types = new Stack<Type>();
            for (Type t = type; t != null && t != typeof(object); t = t.BaseType) types.Push(t);
            MethodInfo[] all = types.SelectMany(t => t.GetMethods(Any | BindingFlags.DeclaredOnly)).ToArray();
            MethodInfo[] bases = all.Select(m => m.GetBaseDefinition()).ToArray();
            return all.Where((m, i) => Array.LastIndexOf(bases, bases[i]) == i);
        }
    }
}
