// The loop of a rendered frame allocates nothing on the managed heap; the cost of a call.
using System;
using System.Diagnostics;
using System.Runtime.InteropServices;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class GarbageTests : ContextTest
    {
        private const int Frames = 200;

        /// <summary>Runs the body until it is warm, then counts what this thread allocates.</summary>
        private static long Allocated(int times, Action<int> body)
        {
            for (int i = 0; i < 20; i++) body(i);
            GC.Collect();
            int collections = GC.CollectionCount(0);
            long before = GC.GetAllocatedBytesForCurrentThread();
            for (int i = 0; i < times; i++) body(20 + i);
            long bytes = GC.GetAllocatedBytesForCurrentThread() - before;
            Assert.AreEqual(collections, GC.CollectionCount(0), "the collector ran");
            return bytes;
        }

        [Test]
        public void TheCounterCounts()
        {
            object kept = null;
            Assert.GreaterOrEqual(Allocated(100, i => kept = new byte[100]), 100 * 100);
            GC.KeepAlive(kept);
        }

        [Test]
        public void ARenderedFrameMakesNoGarbage()
        {
            using (var sensor = new Sensor(Context, "virtual:motion=demo&sex=f&sensor=kinect_v1_320"))
            using (var tracker = new Tracker(Context))
            using (var motion = new Motion(Context))
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (Frame frame = new Frame(Context), tracked = new Frame(Context))
            using (Frame skin = new Frame(Context), dress = new Frame(Context))
            {
                sensor.Start();
                motion.Bind(avatar);
                avatar.Acquire(skin);
                using (var cloth = new Cloth(avatar, garment))
                {
                    cloth.Acquire(dress);
                    var skinPositions = new Float3[skin.Count(StreamKind.Position)];
                    var skinNormals = new Float3[skinPositions.Length];
                    var dressPositions = new Float3[dress.Count(StreamKind.Position)];
                    var dressNormals = new Float3[dressPositions.Length];
                    var depth = new float[320 * 240];
                    var bodies = new Body[16];
                    var joints = new Joint[Counts.JointCount];
                    var colliders = new Collider[64];
                    var packet = new byte[120];
                    var pose = new BodyPose();
                    ulong skinSerial = 0, dressSerial = 0;
                    long bytes = Allocated(Frames, i =>
                    {
                        if (sensor.Acquire(frame, -1) == Result.Ok) tracker.Update(frame, tracked);
                        frame.Write(StreamKind.Depth, depth);
                        int people = tracked.Bodies(bodies);
                        if (people > 0) tracked.Joints(bodies[0].BodyId, joints);
                        motion.Step(tracked, tracked.ActiveBody(), tracked.View(StreamKind.Depth).TimeNs);
                        motion.Pose(pose);
                        avatar.Pose(pose);
                        cloth.BeginStep(1 / 60f);
                        cloth.EndStep();
                        cloth.Carry();
                        avatar.Acquire(skin);
                        cloth.Acquire(dress);
                        skin.Write(StreamKind.Position, skinPositions, ref skinSerial);
                        skin.Write(StreamKind.Normal, skinNormals);
                        dress.Write(StreamKind.Position, dressPositions, ref dressSerial);
                        dress.Write(StreamKind.Normal, dressNormals);
                        avatar.PoseInto(pose, skinPositions, skinNormals);
                        avatar.Colliders(colliders);
                        pose.Pack(Context, packet);
                        cloth.Stats();
                        long now = Context.TimeNs;
                        if (sensor.Acquire(frame, 0) < 0 || now < 0) throw new InvalidOperationException();
                    });
                    Console.WriteLine("garbage: " + bytes + " bytes in " + Frames +
                                      " frames of sensor, tracker, motion, avatar, cloth, buffers");
                    Assert.AreEqual(0, bytes);
                }
            }
        }

        [Test]
        public void FramesOfTheHostMakeNoGarbage()
        {
            var depth = new ushort[320 * 240];
            GCHandle pin = GCHandle.Alloc(depth, GCHandleType.Pinned);
            using (var frame = new Frame(Context))
            {
                long bytes = Allocated(1000, i =>
                {
                    var images = new HostImages
                    {
                        Width = 320, Height = 240, Depth = pin.AddrOfPinnedObject(), TimeNs = i + 1,
                        Intrinsics = new Intrinsics { Fx = 285, Fy = 285, Cx = 160, Cy = 120 }
                    };
                    Frame.Create(Context, ref images, frame);
                });
                Assert.AreEqual(0, bytes);
            }
            pin.Free();
        }

        /// <summary>Prints figures for the README; the bound is loose, as machines differ.</summary>
        [Test]
        public void ACallCostsLittle()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (var frame = new Frame(Context))
            {
                avatar.Acquire(frame);
                double plain = NanosecondsEach(() => Native.vfit_bone_parent(0));
                double held = NanosecondsEach(() => frame.View(StreamKind.Position));
                Console.WriteLine("call: " + plain.ToString("0") + " ns P/Invoke alone, " +
                                  held.ToString("0") +
                                  " ns with the handle held and checked (vfit_frame_view)");
                Assert.Less(held, 20000);
            }
        }

        private static double NanosecondsEach(Action call)
        {
            const int times = 200000;
            for (int i = 0; i < times / 10; i++) call();
            Stopwatch watch = Stopwatch.StartNew();
            for (int i = 0; i < times; i++) call();
            return watch.Elapsed.TotalMilliseconds * 1e6 / times;
        }
    }
}
