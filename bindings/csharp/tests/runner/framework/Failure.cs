// The words for an exception: its message, and the lines of the test through which it came.
using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Reflection;

namespace NUnit.Framework
{
    internal static class Failure
    {
        private const int MaxLines = 6;

        /// <summary>What a method called by reflection threw.</summary>
        internal static Exception Cause(Exception error)
        {
            return error is TargetInvocationException ? error.InnerException ?? error : error;
        }

        internal static string Describe(Exception error)
        {
            Exception cause = Cause(error);
            string text = cause is AssertionException ? cause.Message : Named(cause), lines = Lines(cause);
            for (Exception inner = cause.InnerException; inner != null; inner = inner.InnerException)
                text += "\ncaused by " + Named(inner);
            return lines.Length == 0 ? text : text + "\nat " + lines;
        }

        private static string Named(Exception error)
        {
            return error.GetType().FullName + ": " + error.Message;
        }

        /// <summary>"Support.cs:84, ChainTests.cs:190": the frames with source, innermost first.</summary>
        private static string Lines(Exception error)
        {
            StackFrame[] frames = new StackTrace(error, true).GetFrames() ?? new StackFrame[0];
            return string.Join(", ", frames.Where(IsTest).Take(MaxLines)
                .Select(f => Path.GetFileName(f.GetFileName()) + ":" + f.GetFileLineNumber()).ToArray());
        }

        private static bool IsTest(StackFrame frame)
        {
            MethodBase method = frame.GetMethod();
            if (string.IsNullOrEmpty(frame.GetFileName()) || method == null) return false;
            return method.DeclaringType != null && method.DeclaringType.Assembly != typeof(Failure).Assembly;
        }
    }
}
