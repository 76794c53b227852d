// Runs the tests of one fixture: one object for all of them, SetUp and TearDown around each.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using NUnit.Framework;

namespace Vfit.TestRunner
{
    internal sealed class FixtureRun
    {
        private static readonly object[] nothing = new object[0];

        private readonly Type type;
        private readonly MethodInfo[] setUps, tearDowns;
        private object fixture;

        internal FixtureRun(Type type)
        {
            this.type = type;
            setUps = Discovery.Marked<SetUpAttribute>(type);
            tearDowns = Discovery.Marked<TearDownAttribute>(type).Reverse().ToArray();
        }

        internal IEnumerable<Result> Run(IEnumerable<Case> cases)
        {
            string skipped = Discovery.IgnoreReason(type), broken = skipped == null ? Make() : null;
            foreach (Case one in cases)
            {
                if (skipped != null) yield return new Result(one.Name, Outcome.Skipped, skipped);
                else if (broken != null) yield return new Result(one.Name, Outcome.Failed, broken);
                else yield return Run(one);
            }
            string left = Dispose();
            if (left != null) yield return new Result(type.FullName + ".Dispose", Outcome.Failed, left);
        }

        /// <summary>Returns why none of its tests can run, or null.</summary>
        private string Make()
        {
            foreach (MethodInfo method in setUps.Concat(tearDowns))
            {
                string fault = Discovery.FaultOf(method, nothing);
                if (fault != null) return "not runnable: " + method.Name + " " + fault;
            }
            if (type.ContainsGenericParameters) return "not runnable: the fixture is generic";
            try
            {
                if (!type.IsAbstract) fixture = Activator.CreateInstance(type);
            }
            catch (Exception error)
            {
                return "constructor: " + Failure.Describe(error);
            }
            return null;
        }

        private string Dispose()
        {
            try
            {
                (fixture as IDisposable)?.Dispose();
            }
            catch (Exception error)
            {
                return Failure.Describe(error);
            }
            return null;
        }

        private Result Run(Case one)
        {
            string skipped = Discovery.IgnoreReason(one.Method);
            if (skipped != null) return new Result(one.Name, Outcome.Skipped, skipped);
            string fault = Discovery.FaultOf(one.Method, one.Arguments);
            if (fault != null) return new Result(one.Name, Outcome.Failed, "not runnable: it " + fault);

            Result result = Attempt(one.Name, "SetUp: ", () => Call(setUps));
            if (result.Outcome == Outcome.Passed) result = Attempt(one.Name, "", () => Call(one));
            // As in NUnit, TearDown runs after a failed SetUp too.
            Result after = Attempt(one.Name, "TearDown: ", () => Call(tearDowns));
            if (after.Outcome == Outcome.Passed) return result;
            string before = result.Outcome == Outcome.Failed ? result.Reason + "\n" : "";
            return new Result(one.Name, Outcome.Failed, before + after.Reason);
        }

        private void Call(MethodInfo[] methods)
        {
            foreach (MethodInfo method in methods) method.Invoke(fixture, nothing);
        }

        private void Call(Case one)
        {
            try
            {
                one.Method.Invoke(fixture, one.Arguments);
            }
            catch (ArgumentException)   // what the test itself throws comes as TargetInvocationException
            {
                throw new AssertionException("not runnable: the arguments do not fit the parameters");
            }
        }

        private static Result Attempt(string name, string where, Action action)
        {
            try
            {
                action();
                return new Result(name, Outcome.Passed);
            }
            catch (Exception error)
            {
                Exception cause = Failure.Cause(error);
                if (cause is IgnoreException) return new Result(name, Outcome.Skipped, where + cause.Message);
                return new Result(name, Outcome.Failed, where + Failure.Describe(error));
            }
        }
    }
}
