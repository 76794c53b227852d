// The command line: [--report FILE] [--only PART]... ASSEMBLY...
// Exit code: 0 if all tests passed or were skipped, 1 if one failed, 2 if an assembly has no test or an
// argument is wrong.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;

namespace Vfit.TestRunner
{
    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            string report = null;
            var only = new List<string>();
            var assemblies = new List<string>();
            for (int i = 0; i < arguments.Length; i++)
            {
                bool last = i + 1 == arguments.Length;
                if (arguments[i] == "--report" && !last) report = arguments[++i];
                else if (arguments[i] == "--only" && !last) only.Add(arguments[++i]);
                else if (arguments[i].StartsWith("-")) return Refuse("cannot read " + arguments[i]);
                else assemblies.Add(Path.GetFullPath(arguments[i]));
            }
            if (assemblies.Count == 0) return Refuse("names no assembly");
            return Run(assemblies, only.ToArray(), report);
        }

        private static int Run(List<string> assemblies, string[] only, string report)
        {
            var results = new List<Result>();
            var empty = new List<string>();
            foreach (string assembly in assemblies)
            {
                List<Result> own = DomainRun.Run(assembly, only);
                if (own.Count == 0) empty.Add(Path.GetFileName(assembly));
                results.AddRange(own);
            }
            Report.PrintSummary(results);
            if (report != null) Report.Write(report, results);
            if (results.Any(r => r.Outcome == Outcome.Failed)) return 1;
            // With --only, the tests may all be in one of the assemblies.
            bool none = only.Length > 0 ? results.Count == 0 : empty.Count > 0;
            return none ? Refuse("no test in " + string.Join(", ", empty.ToArray())) : 0;
        }

        private static int Refuse(string reason)
        {
            Console.Error.WriteLine("test runner: " + reason);
            return 2;
        }
    }
}
