// Structs have the header's sizes and offsets, by tests/abi/offsets.c, which the C build checks.
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class LayoutTests
    {
        private static readonly string[] lines =
            File.ReadAllLines(Path.Combine(Support.Root, "tests", "abi", "offsets.c"));
        private static readonly string header =
            File.ReadAllText(Path.Combine(Support.Root, "include", "vfit.h"));

        [Test]
        public void EveryStructHasTheSizeOfTheHeaders()
        {
            int checkedStructs = 0;
            foreach (string line in lines)
            {
                Match match = Regex.Match(line, @"^SIZE\((vfit_\w+), (\d+)\)");
                if (!match.Success || !IsPublic(match.Groups[1].Value)) continue;
                Type type = TypeOf(match.Groups[1].Value);
                Assert.AreEqual(int.Parse(match.Groups[2].Value), Marshal.SizeOf(type), type.Name);
                Assert.AreEqual(Marshal.SizeOf(type), InMemory(type), type.Name + " in managed memory");
                checkedStructs++;
            }
            Assert.GreaterOrEqual(checkedStructs, 39);
        }

        [Test]
        public void EveryFieldLiesWhereTheHeadersDoes()
        {
            int checkedFields = 0;
            foreach (string line in lines)
            {
                Match match = Regex.Match(line, @"^OFFSET\((vfit_\w+), (\w+), (\d+)\)");
                if (!match.Success || !IsPublic(match.Groups[1].Value)) continue;
                Type type = TypeOf(match.Groups[1].Value);
                string field = FieldOf(type, match.Groups[2].Value);
                int wanted = int.Parse(match.Groups[3].Value);
                Assert.AreEqual(wanted, (int)Marshal.OffsetOf(type, field), type.Name + "." + field);
                checkedFields++;
            }
            Assert.Greater(checkedFields, 200);
        }

        [Test]
        public void EveryFunctionOfTheHeaderIsExportedByTheLibrary()
        {
            MethodInfo[] functions = typeof(Native).GetMethods(BindingFlags.Static | BindingFlags.NonPublic)
                .Where(m => m.Name.StartsWith("vfit_")).ToArray();
            int declared = Regex.Matches(header, "^VFIT_API ", RegexOptions.Multiline).Count;
            Assert.AreEqual(declared, functions.Length);
            foreach (MethodInfo function in functions) Marshal.Prelink(function);
        }

        [Test]
        public void EveryFunctionHasItsPlaceInAClass()
        {
            string package = Path.Combine(Support.Root, "bindings", "csharp", "unity", "com.vfit.sdk");
            string folder = Path.Combine(package, "Runtime", "Binding");
            string written = string.Concat(Directory.GetFiles(folder, "*.cs").Select(File.ReadAllText));
            const string declaration = @"^VFIT_API .*?(vfit_\w+)\(";
            foreach (Match match in Regex.Matches(header, declaration, RegexOptions.Multiline))
            {
                string name = match.Groups[1].Value;
                if (Regex.IsMatch(name, "_(destroy|close|release)$")) continue;     // of the handles
                string wrapped = "Calls." + Pascal(name.Substring("vfit_".Length)) + "(";
                bool used = written.Contains(wrapped) || written.Contains("Native." + name + "(");
                Assert.IsTrue(used, name);
            }
        }

        private static bool IsPublic(string name)
        {
            return header.Contains("typedef struct " + name + " ");
        }

        private static string Pascal(string name)
        {
            return string.Concat(name.Split('_').Select(w => char.ToUpperInvariant(w[0]) + w.Substring(1)));
        }

        private static Type TypeOf(string name)
        {
            return typeof(Context).Assembly.GetType("Vfit." + Pascal(name.Substring("vfit_".Length)), true);
        }

        private static string FieldOf(Type type, string name)
        {
            string pascal = Pascal(name), camel = char.ToLowerInvariant(pascal[0]) + pascal.Substring(1);
            const BindingFlags all = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;
            foreach (string candidate in new[] { camel, camel + "Bytes", pascal, "Id" })
                if (type.GetField(candidate, all) != null) return candidate;
            throw new MissingFieldException(type.Name, name);
        }

        /// <summary>Distance of two neighbours in an array.</summary>
        private static long InMemory(Type type)
        {
            Array array = Array.CreateInstance(type, 2);
            GCHandle pin = GCHandle.Alloc(array, GCHandleType.Pinned);
            try
            {
                return Marshal.UnsafeAddrOfPinnedArrayElement(array, 1).ToInt64() -
                       Marshal.UnsafeAddrOfPinnedArrayElement(array, 0).ToInt64();
            }
            finally
            {
                pin.Free();
            }
        }
    }
}
