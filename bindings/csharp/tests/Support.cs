// What the tests share: contexts, a recording of the virtual person, real recordings where there are any.
using System;
using System.Collections.Generic;
using System.IO;
using NUnit.Framework;

namespace Vfit.Tests
{
    /// <summary>A context of its own for each test.</summary>
    public abstract class ContextTest
    {
        protected Context Context;

        [SetUp]
        public void MakeContext()
        {
            Context = new Context();
        }

        [TearDown]
        public void EndContext()
        {
            Context.Dispose();
        }
    }

    public static class Support
    {
        internal const string Person = "virtual:motion=demo&sex=f&seed=7&sensor=kinect_v1_320&frames=60";

        /// <summary>The source tree: scripts/test-csharp names it.</summary>
        internal static string Root
        {
            get { return Needed("VFIT_SOURCE_DIR"); }
        }

        internal static string Library
        {
            get { return Path.Combine(Needed("VFIT_BUILD_DIR"), "lib"); }
        }

        /// <summary>A new empty folder, removed with the process.</summary>
        public static string TemporaryFolder()
        {
            string path = Path.Combine(Path.GetTempPath(), "vfit-csharp-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(path);
            AppDomain.CurrentDomain.DomainUnload += (sender, e) => Directory.Delete(path, true);
            return path;
        }

        private static string recorded;

        /// <summary>A recording of the virtual person, made once: "recording:PATH".</summary>
        public static string Recording()
        {
            if (recorded != null) return recorded;
            string path = Path.Combine(TemporaryFolder(), "person");
            using (var context = new Context())
            using (var sensor = new Sensor(context, Person))
            using (var recorder = new Recorder(context, path, "virtual"))
                foreach (Frame frame in sensor.Frames())
                    recorder.Write(frame);
            return recorded = "recording:" + path;
        }

        /// <summary>Folders of real recordings; the test is skipped where there are none.</summary>
        internal static List<string> RealRecordings()
        {
            string shared = Environment.GetEnvironmentVariable("VFIT_SHARED");
            if (shared == null) shared = Path.Combine(Root, "..", "shared");
            string folder = Path.Combine(shared, "data", "recordings");
            var found = new List<string>();
            if (Directory.Exists(folder))
                foreach (string recording in Directory.GetDirectories(folder))
                    if (File.Exists(Path.Combine(recording, "camera.json"))) found.Add(recording);
            found.Sort(StringComparer.Ordinal);
            if (found.Count == 0) Assert.Ignore("real recordings are absent: " + folder);
            return found;
        }

        /// <summary>The result code that a call throws with.</summary>
        internal static Result CodeOf(TestDelegate call)
        {
            return Assert.Throws<VfitException>(call).Code;
        }

        public static Avatar MakeAvatar(Context context)
        {
            return Avatar.FromMeasures(context, new[] { Measurements.Known("stature_m", 1.7f) });
        }

        /// <summary>A rest pose that turns by a step each time, so that no step is asleep.</summary>
        internal static void Turn(BodyPose pose, int step)
        {
            double half = 0.05 * Math.Sin(0.1 * step);
            pose.Bones[(int)BoneId.LeftUpperArm].Rotation =
                new Float4(0, 0, (float)Math.Sin(half), (float)Math.Cos(half));
        }

        private static string Needed(string variable)
        {
            string value = Environment.GetEnvironmentVariable(variable);
            if (string.IsNullOrEmpty(value))
                throw new InvalidOperationException(variable + " is not set: run scripts/test-csharp");
            return value;
        }
    }
}
