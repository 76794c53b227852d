// Errors carry the code and the library's own sentence; wrong numbers and texts are refused.
using System;
using System.IO;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class ErrorTests : ContextTest
    {
        [Test]
        public void EachErrorHasItsCodeAndASentence()
        {
            var cases = new[]
            {
                Case(Result.ErrorUnsupported, () => new Sensor(Context, "nothing:")),
                Case(Result.ErrorIo, () => new Sensor(Context, "recording:/nowhere")),
                Case(Result.ErrorArgument, () => new Sensor(Context, "")),
                Case(Result.ErrorIo, () => SizeChart.Open(Context, "no_such_chart")),
                Case(Result.ErrorData, () => SizeChart.Load(Context, "{")),
                Case(Result.ErrorData, () => Garment.Load(Context, "not json")),
                Case(Result.ErrorState, () => new Scan(Context).Measure()),
                Case(Result.ErrorState, () => new Motion(Context).Pose(new BodyPose())),
                Case(Result.ErrorArgument,
                     () => new Motion(Context, new MotionDesc { Filter = (PositionFilter)99 })),
                Case(Result.ErrorArgument, () => new Motion(Context, new MotionDesc { PredictionS = 1 })),
                Case(Result.ErrorArgument, () => new Scan(Context, new ScanDesc { Sex = (Sex)7 })),
                Case(Result.ErrorArgument,
                     () => Avatar.FromShape(Context, new[] { new ShapeValue { Key = "wings", Value = 1 } })),
                Case(Result.ErrorData, () => Avatar.FromMeasures(Context, new Measurement[0])),
                Case(Result.ErrorArgument, () => new Context(new ContextOptions { Axes = (Axes)9 })),
                Case(Result.ErrorArgument, () => new Context(new ContextOptions { WorkerCount = 100000 })),
            };
            foreach (Tuple<Result, TestDelegate> c in cases)
            {
                VfitException error = Assert.Throws<VfitException>(c.Item2, c.Item1.ToString());
                Assert.AreEqual(c.Item1, error.Code, error.Message);
                Assert.That(error.Message.Length, Is.GreaterThan(8), error.Message);
                StringAssert.DoesNotContain("ERROR_", error.Message);
            }
            Collect();
            Assert.AreEqual(0u, Context.Stats().HandleCount, "a failed call leaves no object");
        }

        [Test]
        public void NumbersThatAreNoneAreRefused()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (var cloth = new Cloth(avatar, garment))
            using (var sensor = new Sensor(Context, "virtual:frames=1"))
            using (var frame = new Frame(Context))
            {
                Assert.Throws<VfitException>(() => cloth.Step(float.NaN));
                Assert.Throws<VfitException>(() => cloth.SetWind(new Float3(float.NaN, 0, 0)));
                Assert.Throws<VfitException>(() => cloth.SetQuality(8, float.NaN));
                Assert.Throws<ArgumentException>(() => sensor.Acquire(frame, double.NaN));
                BodyPose pose = BodyPose.Rest(new Float3(0, float.NaN, 0));
                Assert.Throws<VfitException>(() => avatar.Pose(pose));
                pose = BodyPose.Rest(new Float3(0, 1, 0));
                pose.Bones[3].Rotation.X = float.PositiveInfinity;
                Assert.Throws<VfitException>(() => avatar.Pose(pose));
                Measurement[] bad = { Measurements.Known("stature_m", float.NaN) };
                Assert.Throws<VfitException>(() => Avatar.FromMeasures(Context, bad));
                Assert.Throws<VfitException>(() => cloth.HideSkin(new byte[3]));
            }
        }

        [Test]
        public void GarmentsTellHowTheySitAndWhatCannotBeWorn()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress_pattern"))
            using (var cloth = new Cloth(avatar, garment, default(ClothDesc), "XXL"))
            using (var frame = new Frame(Context))
            {
                Assert.IsTrue(garment.Parts().Length > 0);
                for (int i = 0; i < 10; i++) cloth.Step(1f / 60f);
                FitZone[] zones = cloth.Fit();
                Assert.IsTrue(zones.Length > 0);
                foreach (FitZone zone in zones)
                    Assert.AreEqual(zone.GarmentM - zone.BodyM, zone.EaseM, 1e-4f);
                Assert.Throws<VfitException>(() => cloth.SetSize("QQ"));
                Assert.Throws<VfitException>(() => cloth.FitMap(new float[3]));
                cloth.SetSize("XL");
                cloth.SetSize(null);
            }
        }

        [Test]
        public void CountsBeyondAnArrayAreRefused()
        {
            using (var tracker = new Tracker(Context))
            using (var frame = new Frame(Context))
            {
                Assert.Throws<ArgumentOutOfRangeException>(() => tracker.Hint(new JointHint[2], 3));
                Float3 position;
                Float4 rotation;
                Assert.Throws<ArgumentNullException>(
                    () => Context.AlignWorlds(null, new Float3[8], out position, out rotation));
                Assert.Throws<ArgumentOutOfRangeException>(
                    () => Context.AlignWorlds(new Float3[9], new Float3[8], out position, out rotation));
                Assert.Throws<VfitException>(
                    () => Context.AlignWorlds(new Float3[8], new Float3[8], out position, out rotation));
                Assert.Throws<ArgumentOutOfRangeException>(
                    () => tracker.Submit(frame, default(Body), new Joint[2], -1, frame));
                ScanState state;
                using (var scan = new Scan(Context, new ScanDesc { CameraCount = 2 }))
                    Assert.AreEqual(
                        Result.ErrorArgument,
                        Assert.Throws<VfitException>(() => scan.AddFrom(2, frame, 1, out state)).Code);
                Assert.Throws<VfitException>(
                    () => tracker.HintFrom(frame, 1, new Float3(0, 0, 0), new Float4(0, 0, 0, 0)));
                var pose = new BodyPose { Count = 1000 };
                Assert.Throws<ArgumentOutOfRangeException>(() => pose.Pack(Context, new byte[200]));
                Assert.Throws<ArgumentOutOfRangeException>(() => pose.Unpack(Context, new byte[10], 11));
            }
        }

        [Test]
        public void TargetsThatAreTooSmallOrOfAnotherFormatAreRefusedAndStayAsTheyWere()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (var mesh = new Frame(Context))
            {
                avatar.Acquire(mesh);
                var few = new Float3[8];
                Assert.AreEqual(
                    Result.ErrorCapacity, Support.CodeOf(() => mesh.Write(StreamKind.Position, few)));
                Assert.AreEqual(0, few[0].Y);
                Assert.AreEqual(
                    Result.ErrorUnsupported,
                    Support.CodeOf(() => mesh.Write(StreamKind.Position, new int[100000])));
                Assert.AreEqual(
                    Result.ErrorArgument, Support.CodeOf(() => mesh.Write(StreamKind.Depth, new float[100])));
                Assert.Throws<ArgumentOutOfRangeException>(
                    () => mesh.Write(StreamKind.Position, (IntPtr)16, -1, Format.F32x3, 0));
                Assert.Throws<VfitException>(
                    () => mesh.Write(StreamKind.Position, IntPtr.Zero, 1 << 30, Format.F32x3, 0));
            }
        }

        [Test]
        public void ListsThatAreTooShortAreRefused()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            {
                Assert.AreEqual(Result.ErrorCapacity, Support.CodeOf(() => avatar.Joints(new Joint[3])));
                Assert.AreEqual(Result.ErrorCapacity, Support.CodeOf(() => avatar.Joints(new Joint[0])));
                Assert.AreEqual(Counts.JointCount, avatar.Joints(new Joint[64]));
            }
        }

        [Test]
        public void HugeArraysPass()
        {
            var many = new Measurement[200000];
            for (int i = 0; i < many.Length; i++) many[i].Value = 1;
            Assert.Throws<VfitException>(() => Measurements.Write(many, Sex.Unknown));
            using (var tracker = new Tracker(Context))
                Assert.Throws<VfitException>(() => tracker.Hint(new JointHint[1000000], 1000000));
        }

        [Test]
        public void TextsAreUtf8AndHaveNoNullInside()
        {
            string folder = Path.Combine(Support.TemporaryFolder(), "Größe 測定");
            using (var sensor = new Sensor(Context, "virtual:frames=1&sensor=kinect_v1_320"))
            {
                using (var recorder = new Recorder(Context, folder))
                    foreach (Frame frame in sensor.Frames()) recorder.Write(frame);
                Assert.IsTrue(File.Exists(Path.Combine(folder, "camera.json")));
                using (new Sensor(Context, "recording:" + folder)) { }
            }
            Assert.Throws<ArgumentException>(() => new Sensor(Context, "virtual:\0recording:x"));
            Assert.Throws<ArgumentException>(() => new ShapeValue { Key = new string('k', 48) });
            var error = Assert.Throws<VfitException>(() => new Sensor(Context, "recording:/nowhere/測定"));
            StringAssert.Contains("測定", error.Message);
        }

        [Test]
        public void NamesAreThoseOfTheLibrary()
        {
            Assert.AreEqual("0.2.0", Library.Version);
            Assert.That(Library.Describe().Simd, Is.Not.Empty);
            Assert.AreEqual("LEFT_ELBOW", Library.JointName(JointId.LeftElbow));
            Assert.AreEqual("leftUpperArm", Library.BoneName(BoneId.LeftUpperArm));
            Assert.AreEqual("", Library.BoneName((BoneId)99));
            Assert.AreEqual(-1, Library.BoneParent(BoneId.Hips));
            Assert.AreEqual("ERROR_STATE", Library.ResultName(Result.ErrorState));
            Assert.That(Library.Measures().Exists(m => m.Key == "chest_girth_m" && m.Value.Length > 10));
        }

        [Test]
        public void OptionsModesPluginsAndProfileAreListed()
        {
            using (var sensor = new Sensor(Context, "virtual:motion=scan&frames=2"))
            {
                Assert.That(Array.Find(sensor.Options(), o => o.Key == "motion").Value, Is.EqualTo("scan"));
                Assert.Greater(sensor.Modes()[0].Width, 0);
                sensor.SetOption("frames", "1");
                Assert.AreEqual(
                    Result.ErrorArgument, Support.CodeOf(() => sensor.SetOption("motion", "fly")));
                int frames = 0;
                foreach (Frame frame in sensor.Frames()) frames++;
                Assert.AreEqual(1, frames);
                Assert.AreEqual(1ul, sensor.Stats().Taken);
            }
            Assert.That(Array.Exists(Context.Plugins(), p => p.Schemes.Contains("virtual")));
            Assert.That(Array.Exists(Context.Sensors(), s => s.Uri.StartsWith("virtual:")));
            Assert.That(Array.Exists(Context.Profiles(), p => p.Stage == "track"));
            Assert.AreEqual(Context.SensorChanges(), Context.SensorChanges());
            Context.ResetProfile();
            Assert.Greater(Context.TimeNs, 0);
        }

        internal static void Collect()
        {
            for (int i = 0; i < 3; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
        }

        private static Tuple<Result, TestDelegate> Case(Result code, TestDelegate call)
        {
            return Tuple.Create(code, call);
        }
    }
}
