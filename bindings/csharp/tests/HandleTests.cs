// Null, closed, stale and foreign objects: an exception each, never a crash.
using System;
using System.Linq;
using System.Reflection;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class HandleTests : ContextTest
    {
        [Test]
        public void AClosedObjectIsRefused()
        {
            var motion = new Motion(Context);
            motion.Dispose();
            motion.Dispose();
            Assert.IsTrue(motion.IsClosed);
            Assert.Throws<ObjectDisposedException>(() => motion.Reset());
            Assert.AreEqual(0u, Context.Stats().HandleCount);
        }

        [Test]
        public void AnObjectWhoseContextWasClosedIsStale()
        {
            var context = new Context();
            var scan = new Scan(context);
            var frame = new Frame(context);
            context.Dispose();
            Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => scan.Reset()));
            Assert.Throws<ObjectDisposedException>(() => new Scan(context));
            Assert.Throws<ObjectDisposedException>(() => context.Stats());
            scan.Dispose();
            frame.Dispose();
        }

        [Test]
        public void ClothGoesWithItsAvatar()
        {
            Avatar avatar = Support.MakeAvatar(Context);
            Cloth cloth;
            using (Garment garment = Garment.Open(Context, "sundress")) cloth = new Cloth(avatar, garment);
            avatar.Dispose();
            Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => cloth.Step(0.01f)));
            cloth.Dispose();
        }

        [Test]
        public void NullObjectsAreNamed()
        {
            var motion = new Motion(Context);
            var tracker = new Tracker(Context);
            var frame = new Frame(Context);
            TestDelegate[] calls =
            {
                () => new Sensor(null, "virtual:"), () => new Sensor(Context, null), () => new Scan(null),
                () => new Tracker(null), () => new Motion(null), () => new Frame(null),
                () => new Recorder(null, "x"),
                () => new Recorder(Context, null), () => new Cloth(null, null), () => Garment.Open(null, "x"),
                () => Garment.Open(Context, null), () => SizeChart.Load(Context, null),
                () => Avatar.FromScan(null),
                () => Avatar.Load(Context, (string)null), () => Avatar.Load(Context, (byte[])null),
                () => Avatar.FromShape(Context, null), () => Avatar.FromMeasures(Context, null),
                () => motion.Bind(null), () => motion.Pose(null), () => tracker.Update(null, frame),
                () => tracker.Update(frame, null), () => tracker.Submit(frame, default(Body), null, 0, frame),
                () => frame.Write(StreamKind.Depth, (float[])null), () => frame.Meta(null),
                () => frame.Bodies(null),
                () => Context.LoadPlugin(null), () => Measurements.Write(null, Sex.Unknown)
            };
            for (int i = 0; i < calls.Length; i++)
                {
                    var error = Assert.Throws<ArgumentNullException>(calls[i], "call " + i);
                    Assert.IsNotNull(error.ParamName, "call " + i);
                }
        }

        [Test]
        public void AnEmptyFrameIsTheNullHandle()
        {
            using (var frame = new Frame(Context))
            using (var tracker = new Tracker(Context))
            {
                Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => frame.View(StreamKind.Depth)));
                Assert.AreEqual(
                    Result.ErrorHandle, Support.CodeOf(() => frame.Write(StreamKind.Depth, new ushort[4])));
                Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => tracker.Update(frame, frame)));
                frame.Clear();
            }
        }

        [Test]
        public void ObjectsOfTwoContextsAreTakenOrRefusedButNeverCrash()
        {
            using (var other = new Context())
            using (var sensor = new Sensor(other, "virtual:frames=2&sensor=kinect_v1_320"))
            using (Frame frame = new Frame(other), mine = new Frame(Context))
            using (Avatar theirs = Support.MakeAvatar(other))
            using (Garment garment = Garment.Open(Context, "sundress"))
            {
                sensor.Start();
                sensor.Acquire(frame, -1);
                TestDelegate[] calls =
                {
                    () => new Tracker(Context).Update(frame, mine), () => new Motion(Context).Bind(theirs),
                    () => new Cloth(theirs, garment), () => new Scan(Context).Add(frame),
                    () => new Recorder(Context, Support.TemporaryFolder()).Write(frame),
                    () => new Motion(Context).Step(frame, 1, 0)
                };
                foreach (TestDelegate call in calls)
                    try
                    {
                        call();
                    }
                    catch (VfitException error)
                    {
                        Assert.AreEqual(Result.ErrorHandle, error.Code, error.Message);
                    }
            }
        }

        /// <summary>All functions that take a handle first, with invented, stale and foreign ids.</summary>
        [Test]
        public void NoFunctionTakesAnIdThatIsNotItsOwn()
        {
            ulong stale, foreign;
            using (var chart = SizeChart.Open(Context, "paper")) stale = Id(chart.Handle);
            var recorderPath = Support.TemporaryFolder();
            using (var other = new Recorder(Context, recorderPath))
            {
                foreign = Id(other.Handle);
                const BindingFlags imports = BindingFlags.Static | BindingFlags.NonPublic;
                foreach (MethodInfo call in typeof(Native).GetMethods(imports))
                {
                    ParameterInfo[] parameters = call.GetParameters();
                    if (call.ReturnType != typeof(Result) || parameters.Length == 0) continue;
                    if (!IsId(parameters[0].ParameterType)) continue;
                    foreach (ulong id in new[] { 1ul, ulong.MaxValue, 0x0100000100000FFFul, stale, foreign })
                    {
                        if (id == foreign && call.Name.StartsWith("vfit_recorder_")) continue;
                        object[] arguments = parameters.Select(p => Argument(p.ParameterType, id)).ToArray();
                        // Some look at their pointers first, which are null here.
                        Assert.That(
                            call.Invoke(null, arguments),
                            Is.EqualTo(Result.ErrorHandle).Or.EqualTo(Result.ErrorArgument),
                            call.Name + " " + id);
                    }
                }
            }
        }

        private static bool IsId(Type type)
        {
            return type.IsValueType && type.Name.EndsWith("Id") && !type.IsEnum;
        }

        private static ulong Id(VfitHandle handle)
        {
            bool held = false;
            ulong id = VfitHandle.Hold(handle, ref held);
            handle.DangerousRelease();
            return id;
        }

        private static object Argument(Type type, ulong id)
        {
            if (type.IsPointer) return null;
            object value = Activator.CreateInstance(type);
            const BindingFlags hidden = BindingFlags.Instance | BindingFlags.NonPublic;
            FieldInfo field = IsId(type) ? type.GetField("Value", hidden) : null;
            if (field != null) field.SetValue(value, id);
            return value;
        }
    }
}
