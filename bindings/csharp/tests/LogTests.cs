// Log lines: polled, or to a callback that may throw; the host's job system as C function pointers.
using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class LogTests
    {
        /// <summary>A plug-in folder that a context warns about.</summary>
        private static ContextOptions Warned(Action<LogLevel, string> log)
        {
            string folder = Support.TemporaryFolder();
            File.WriteAllText(Path.Combine(folder, "vfit_broken.so"), "no library");
            return new ContextOptions { PluginDir = folder, Log = log };
        }

        [Test]
        public void LinesArePolled()
        {
            using (var context = new Context(Warned((level, message) => { })))
            {
                LogLevel level;
                string line;
                context.Plugins();
                Assert.IsTrue(context.NextLog(out level, out line));
                Assert.AreEqual(LogLevel.Warning, level);
                StringAssert.Contains("vfit_broken", line);
                Assert.IsFalse(context.NextLog(out level, out line));
                Assert.AreEqual("", line);
            }
        }

        [Test]
        public void LinesGoToTheCallback()
        {
            var lines = new List<string>();
            using (var context = new Context(Warned((level, message) => lines.Add(level + " " + message))))
                context.Plugins();
            Assert.That(lines, Has.Count.EqualTo(1));
            StringAssert.StartsWith("Warning ", lines[0]);
            StringAssert.Contains("vfit_broken", lines[0]);
        }

        [Test]
        public void WhatACallbackThrowsStaysInIt()
        {
            int calls = 0;
            Action<LogLevel, string> log = (level, message) =>
            {
                calls++;
                throw new InvalidOperationException();
            };
            using (var context = new Context(Warned(log))) context.Plugins();
            Assert.AreEqual(1, calls);
        }

        [Test]
        public void ACallbackMayAskTheContextForItsTime()
        {
            Context context = null;
            long time = 0;
            var options = Warned((level, message) => { if (context != null) time = context.TimeNs; });
            using (context = new Context(options))
            {
                Assert.Throws<VfitException>(() => context.LoadPlugin("/nowhere.so"));
                context.Plugins();
            }
            Assert.GreaterOrEqual(time, 0);
        }

        private static int submitted;

        [MonoPInvokeCallback(typeof(SubmitFn))]
        private static IntPtr RunAtOnce(IntPtr user, IntPtr fn, IntPtr task, uint count)
        {
            submitted++;
            var item = (TaskFn)Marshal.GetDelegateForFunctionPointer(fn, typeof(TaskFn));
            for (uint i = 0; i < count; i++) item(task, i);
            return IntPtr.Zero;
        }

        [MonoPInvokeCallback(typeof(WaitFn))]
        private static void Wait(IntPtr user, IntPtr job) { }

        [Test]
        public void TheHostsJobSystemRunsTheWork()
        {
            SubmitFn submit = RunAtOnce;
            WaitFn wait = Wait;
            var options = new ContextOptions
            {
                NativeSubmit = Marshal.GetFunctionPointerForDelegate(submit),
                NativeWait = Marshal.GetFunctionPointerForDelegate(wait)
            };
            using (var context = new Context(options))
            using (Avatar avatar = Support.MakeAvatar(context))
            {
                avatar.Pose(BodyPose.Rest(new Float3(0, 1, 0)));
                Assert.Greater(submitted, 0);
            }
            GC.KeepAlive(submit);
            GC.KeepAlive(wait);
            options.NativeWait = IntPtr.Zero;
            Assert.AreEqual(Result.ErrorArgument, Support.CodeOf(() => new Context(options)));
            options.Log = (level, message) => { };
            Assert.Throws<ArgumentException>(() => new Context(options));
        }
    }
}
