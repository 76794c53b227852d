// What is printed, and the JSON file: the lists "passed", "failed" and "skipped" of names with reasons.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;

namespace Vfit.TestRunner
{
    internal static class Report
    {
        /// <summary>A line for the fixture and its failures, next to what its tests printed.</summary>
        internal static void PrintFixture(string name, List<Result> results)
        {
            Console.WriteLine(name + ": " + Counts(results));
            foreach (Result failed in Of(results, Outcome.Failed)) PrintReason("FAILED", failed);
        }

        /// <summary>Skipped and failed tests by name, then the counts.</summary>
        internal static void PrintSummary(List<Result> results)
        {
            foreach (Result skipped in Of(results, Outcome.Skipped)) PrintReason("skipped", skipped);
            foreach (Result failed in Of(results, Outcome.Failed)) Console.WriteLine("FAILED " + failed.Name);
            Console.WriteLine(results.Count + " tests: " + Counts(results));
        }

        internal static void Write(string path, List<Result> results)
        {
            string[] lists =
            {
                List("passed", Of(results, Outcome.Passed)), List("failed", Of(results, Outcome.Failed)),
                List("skipped", Of(results, Outcome.Skipped))
            };
            File.WriteAllText(path, "{\n" + string.Join(",\n", lists) + "\n}\n");
        }

        private static string List(string key, List<Result> results)
        {
            string[] items = results.Select(
                r => "    {\"name\": " + Json(r.Name) + ", \"reason\": " + Json(r.Reason) + "}").ToArray();
            string text = items.Length == 0 ? "" : "\n" + string.Join(",\n", items) + "\n  ";
            return "  \"" + key + "\": [" + text + "]";
        }

        private static List<Result> Of(List<Result> results, Outcome outcome)
        {
            return results.Where(r => r.Outcome == outcome).ToList();
        }

        private static string Counts(List<Result> results)
        {
            return Of(results, Outcome.Passed).Count + " passed, " + Of(results, Outcome.Failed).Count +
                   " failed, " + Of(results, Outcome.Skipped).Count + " skipped";
        }

        private static void PrintReason(string head, Result result)
        {
            Console.WriteLine(head + " " + result.Name + "\n    " + result.Reason.Replace("\n", "\n    "));
        }

        private static string Json(string text)
        {
            var json = new StringBuilder("\"");
            foreach (char c in text)
            {
                if (c == '"' || c == '\\') json.Append('\\').Append(c);
                else if (c == '\n') json.Append("\\n");
                else if (c < ' ' || char.IsSurrogate(c)) json.Append("\\u").Append(((int)c).ToString("x4"));
                else json.Append(c);
            }
            return json.Append('"').ToString();
        }
    }
}
