// Runs the tests of one assembly inside of an application domain of its own, which is unloaded afterwards.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using NUnit.Framework;

namespace Vfit.TestRunner
{
    internal sealed class DomainRun : MarshalByRefObject
    {
        /// <summary>Unloading runs the handlers that remove files; if it fails, a test failed.</summary>
        internal static List<Result> Run(string assembly, string[] only)
        {
            AppDomainSetup setup = AppDomain.CurrentDomain.SetupInformation;
            AppDomain domain = AppDomain.CreateDomain(assembly, null, setup);
            var run = (DomainRun)domain.CreateInstanceAndUnwrap(
                typeof(DomainRun).Assembly.FullName, typeof(DomainRun).FullName);
            var results = new List<Result>(run.RunTests(assembly, only));
            try
            {
                AppDomain.Unload(domain);
            }
            catch (Exception error)
            {
                results.Add(new Result(assembly, Outcome.Failed, "unloading: " + Failure.Describe(error)));
            }
            return results;
        }

        /// <summary>The proxy of this object does not expire, however long the tests take.</summary>
        public override object InitializeLifetimeService()
        {
            return null;
        }

        private Result[] RunTests(string assembly, string[] only)
        {
            var results = new List<Result>();
            foreach (Type fixture in Discovery.Fixtures(Assembly.LoadFrom(assembly)))
            {
                Case[] cases = Discovery.Cases(fixture).Where(c => IsWanted(c.Name, only)).ToArray();
                if (cases.Length == 0) continue;
                List<Result> own = new FixtureRun(fixture).Run(cases).ToList();
                Report.PrintFixture(fixture.FullName, own);
                results.AddRange(own);
            }
            return results.ToArray();
        }

        private static bool IsWanted(string name, string[] only)
        {
            return only.Length == 0 || only.Any(part => name.IndexOf(part, StringComparison.Ordinal) >= 0);
        }
    }
}
