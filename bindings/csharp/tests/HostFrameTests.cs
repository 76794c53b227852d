// Frames from the host's own pixels, copied and lent, and joints from its own middleware.
using System;
using System.Runtime.InteropServices;
using System.Threading;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class HostFrameTests : ContextTest
    {
        private const int Width = 160, Height = 120;
        private static readonly Intrinsics intrinsics =
            new Intrinsics { Fx = 120, Fy = 120, Cx = 79.5f, Cy = 59.5f };

        /// <summary>A box person 2 m away.</summary>
        private static ushort[] Depth(byte[] users)
        {
            var depth = new ushort[Width * Height];
            for (int i = 0; i < depth.Length; i++)
            {
                bool inside = i / Width >= 10 && i / Width < 110 && i % Width >= 65 && i % Width < 95;
                depth[i] = (ushort)(inside ? 2000 : 3000);
                if (users != null && inside) users[i] = 1;
            }
            return depth;
        }

        private static Joint[] Standing()
        {
            float[,] places =
            {
                { 0, 1.60f }, { 0, 1.42f }, { 0, 1.15f }, { 0.18f, 1.38f }, { -0.18f, 1.38f },
                { 0.46f, 1.38f }, { -0.46f, 1.38f },
                { 0.75f, 1.38f }, { -0.75f, 1.38f }, { 0.10f, 0.90f }, { -0.10f, 0.90f },
                { 0.10f, 0.50f }, { -0.10f, 0.50f },
                { 0.10f, 0.08f }, { -0.10f, 0.08f }
            };
            var joints = new Joint[places.GetLength(0)];
            for (int i = 0; i < joints.Length; i++)
            {
                joints[i].Id = (JointId)i;
                joints[i].State = JointState.Measured;
                joints[i].Confidence = 1;
                joints[i].Position = new Float3(places[i, 0], places[i, 1], -2);
            }
            return joints;
        }

        [Test]
        public void PixelsAreCopied()
        {
            var users = new byte[Width * Height];
            ushort[] depth = Depth(users);
            using (Frame frame = Frame.FromDepth(Context, depth, users, Width, Height, intrinsics, 5))
            {
                depth[0] = 7;
                var back = new ushort[depth.Length];
                frame.Write(StreamKind.Depth, back);
                Assert.AreEqual(3000, back[0]);
                var metres = new float[depth.Length];
                frame.Write(StreamKind.Depth, metres);
                Assert.AreEqual(3.0f, metres[0], 1e-6f);
                View view = frame.View(StreamKind.UserMap);
                Assert.AreEqual(5, view.TimeNs);
                Assert.AreEqual(1, Marshal.ReadByte(view.Data, (int)(60 * view.RowStride + 80)));
                Assert.AreEqual(120, frame.Intrinsics().Fx);
                Assert.AreEqual(FloorState.Default, frame.Camera().FloorState);
                Assert.IsNull(frame.Meta("measures"));
            }
        }

        [Test]
        public void LentPixelsComeBackOnce()
        {
            ushort[] depth = Depth(null);
            GCHandle pin = GCHandle.Alloc(depth, GCHandleType.Pinned);
            int released = 0;
            var images = new HostImages
            {
                Width = Width, Height = Height, Depth = pin.AddrOfPinnedObject(), Intrinsics = intrinsics
            };
            Action release = () =>
            {
                Interlocked.Increment(ref released);
                throw new InvalidOperationException();
            };
            using (var frame = new Frame(Context))
            {
                Frame.Lend(Context, ref images, release, frame);
                Assert.AreEqual(pin.AddrOfPinnedObject(), frame.View(StreamKind.Depth).Data, "no copy");
                Assert.AreEqual(0, released);
            }
            Assert.AreEqual(1, released);
            images.Depth = IntPtr.Zero;
            using (var frame = new Frame(Context))
                Assert.Throws<VfitException>(() => Frame.Lend(Context, ref images, () => released++, frame));
            Assert.AreEqual(1, released, "not called where the call fails");
            pin.Free();
        }

        [Test]
        public void ASharedFrameLivesAsLongAsItsLastObject()
        {
            using (Frame frame = Frame.FromDepth(Context, Depth(null), null, Width, Height, intrinsics, 5))
            using (var other = new Frame(Context))
            {
                frame.Share(other);
                frame.Share(frame);
                var closed = new Frame(Context);
                closed.Dispose();
                Assert.Throws<ObjectDisposedException>(() => frame.Share(closed));
                frame.Clear();
                Assert.AreEqual(5, other.View(StreamKind.Depth).TimeNs);
                Assert.AreEqual(1u, Context.Stats().FrameCount);
                other.Clear();
                Assert.AreEqual(0u, Context.Stats().FrameCount);
                Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => frame.Share(other)));
            }
        }

        [Test]
        public void SubmittedJointsDriveMotion()
        {
            using (var tracker = new Tracker(Context))
            using (var motion = new Motion(Context))
            using (Frame frame = Frame.FromDepth(Context, Depth(null), null, Width, Height, intrinsics, 1000))
            {
                Joint[] joints = Standing();
                tracker.Submit(frame, new Body { BodyId = 1, TimeNs = 1000 }, joints, joints.Length, frame);
                Assert.AreEqual(joints.Length, frame.Joints(1).Length);
                Assert.AreEqual(Result.Ok, motion.Step(frame, 1, 1000));
                var pose = new BodyPose();
                motion.Pose(pose);
                Assert.AreEqual(-2, pose.Bones[0].Position.Z, 0.3f);
                Assert.AreEqual(Result.NotReady, motion.Step(frame, 9, 2000), "nobody with that id");
                Assert.GreaterOrEqual(motion.Joints().Length, joints.Length);
                joints[0].Position.X = float.NaN;
                Assert.AreEqual(Result.ErrorData, Support.CodeOf(
                    () => tracker.Submit(frame, new Body { BodyId = 1 }, joints, joints.Length, frame)));
                tracker.Reset();
                tracker.SetActive(0);
                motion.Reset();
            }
        }

        [Test]
        public void WrongImagesAreRefused()
        {
            Assert.Throws<ArgumentException>(
                () => Frame.FromDepth(Context, new ushort[5], null, Width, Height, intrinsics, 0));
            Assert.Throws<ArgumentException>(
                () => Frame.FromDepth(Context, new ushort[0], null, 0, 0, intrinsics, 0));
            Assert.Throws<ArgumentException>(
                () => Frame.FromDepth(Context, Depth(null), new byte[3], Width, Height, intrinsics, 0));
            var bad = new Intrinsics { Fx = float.NaN, Fy = 1 };
            Assert.Throws<VfitException>(
                () => Frame.FromDepth(Context, Depth(null), null, Width, Height, bad, 0));
            Assert.AreEqual(0u, Context.Stats().FrameCount);
        }
    }
}
