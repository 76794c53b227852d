// The outcome of one test, as it leaves the domain that ran it.
using System;

namespace Vfit.TestRunner
{
    internal enum Outcome
    {
        Passed, Failed, Skipped
    }

    [Serializable]
    internal sealed class Result
    {
        internal readonly string Name;
        internal readonly Outcome Outcome;

        /// <summary>Why it failed or was skipped; "" for a passed test.</summary>
        internal readonly string Reason;

        internal Result(string name, Outcome outcome, string reason = "")
        {
            Name = name;
            Outcome = outcome;
            Reason = reason;
        }
    }
}
