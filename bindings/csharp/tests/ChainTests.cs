// The whole chain on a recording: scan, size, avatar, motion, cloth, buffers.
using System;
using System.IO;
using System.Linq;
using System.Text;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class ChainTests : ContextTest
    {
        [Test]
        public void ARecordedPersonIsMeasuredSizedAndDressed()
        {
            using (var sensor = new Sensor(Context, Support.Recording()))
            using (var tracker = new Tracker(Context))
            using (var scan = new Scan(Context, new ScanDesc { Sex = Sex.Female }))
            using (var motion = new Motion(Context))
            using (var tracked = new Frame(Context))
            {
                bool complete = false;
                string truth = null;
                foreach (Frame frame in sensor.Frames())
                {
                    tracker.Update(frame, tracked);
                    truth = truth ?? frame.Meta("measures");
                    ScanState state;
                    complete |= scan.Add(tracked, out state) == Result.Ok;
                    Assert.LessOrEqual(state.FramesTaken, state.FramesWanted);
                    long now = tracked.View(StreamKind.Depth).TimeNs;
                    Assert.AreEqual(Result.Ok, motion.Step(tracked, tracked.ActiveBody(), now));
                }
                Assert.IsTrue(complete);

                Measurement stature;
                Measurement[] measures = scan.Measure();
                Assert.IsTrue(Measurements.TryFind(measures, "stature_m", out stature));
                Assert.That(stature.Value, Is.InRange(1.4f, 2.0f));
                Assert.That(stature.Sigma, Is.GreaterThan(0).And.LessThan(0.1f));
                Assert.AreEqual(1u, stature.Observed);
                Assert.Greater(scan.Colliders().Length, 10);
                Assert.That(scan.Scale("short_sleeves").X, Is.InRange(0.5f, 2.0f));

                using (Garment garment = Garment.Open(Context, "sundress"))
                using (SizeChart chart = SizeChart.Open(Context, garment.Describe().SizeChart))
                using (Avatar avatar = Avatar.FromScan(scan, new AvatarDesc { Sex = Sex.Female }))
                {
                    string kind = garment.Describe().GarmentKind;
                    Size[] sizes = chart.Recommend(kind, measures);
                    Assert.AreEqual(1.0, sizes.Sum(s => s.Probability), 1e-4);
                    Assert.That(sizes.Select(s => s.Probability), Is.Ordered.Descending);
                    Assert.That(chart.Rows().Select(r => r.Label), Has.Member(sizes[0].Label));
                    Assert.That(garment.SizeLabels(), Is.Not.Null);

                    motion.Bind(avatar);
                    var pose = new BodyPose();
                    motion.Pose(pose);
                    Assert.AreEqual(Counts.BoneCount, pose.Count);
                    avatar.Pose(pose);
                    using (var cloth = new Cloth(avatar, garment))
                    using (var mesh = new Frame(Context))
                    {
                        for (int i = 0; i < 20; i++) cloth.Step(1 / 60f);
                        cloth.BeginStep(1 / 60f);
                        cloth.EndStep();
                        ulong stepped = cloth.StateHash();
                        cloth.Carry();
                        Assert.AreEqual(stepped, cloth.StateHash());
                        cloth.Acquire(mesh);
                        var positions = new Float3[mesh.Count(StreamKind.Position)];
                        Assert.AreEqual(garment.Describe().VertexCount, positions.Length);
                        Assert.AreEqual(Result.Ok, mesh.Write(StreamKind.Position, positions));
                        Assert.That(positions.Max(p => p.Y), Is.InRange(0.8f, 1.8f));
                        var indices = new int[mesh.Count(StreamKind.Index)];
                        mesh.Write(StreamKind.Index, indices);
                        Assert.That(indices, Is.All.InRange(0, positions.Length - 1));
                        Assert.AreEqual(0, indices.Length % 3);
                        Assert.That(cloth.Stats().StrainMean, Is.InRange(-0.5f, 0.5f));
                        Assert.AreNotEqual(0, cloth.StateHash());
                        var hidden = new byte[avatar.Describe().IndexCount / 3];
                        cloth.HideSkin(hidden);
                        Assert.That(hidden.Count(h => h == 1), Is.GreaterThan(100));
                    }
                }
                Assert.IsNotNull(truth);
            }
        }

        [Test]
        public void AnOutfitIsTestedForCrossings()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (var inner = new Cloth(avatar, garment))
            using (var outer = new Cloth(avatar, garment))
            {
                foreach (var cloth in new[] { inner, outer }) cloth.Step(1 / 60f);
                Crossing twice = Cloth.CheckOutfit(inner, outer).Single(c => c.Kind == CrossingKind.Cloth);
                Assert.AreEqual(0u, twice.Cloth);
                Assert.AreEqual(1u, twice.Other);
                Assert.Greater(twice.PairCount, 100u);
                Assert.That(Cloth.CheckOutfit(inner).Select(c => c.Kind), Has.No.Member(CrossingKind.Cloth));
                Assert.Throws<VfitException>(() => Cloth.CheckOutfit());
                Assert.Throws<VfitException>(() => Cloth.CheckOutfit(inner, inner));
            }
        }

        [Test]
        public void TheSkinBelowAnOutfitIsTheAvatarsMesh()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (var cloth = new Cloth(avatar, garment))
            using (var own = new Frame(Context))
            using (var skin = new Frame(Context))
            {
                cloth.Step(1 / 60f);
                avatar.Acquire(own);
                Assert.AreEqual(0u, Cloth.AcquireSkin(skin, cloth));
                Assert.AreEqual(own.View(StreamKind.Position).Width, skin.View(StreamKind.Position).Width);
                Assert.Throws<VfitException>(() => Cloth.AcquireSkin(skin));
                Assert.Throws<VfitException>(() => Cloth.AcquireSkin(skin, cloth, cloth));
                Assert.Throws<ArgumentNullException>(() => Cloth.AcquireSkin(skin, cloth, null));
            }
        }

        [Test]
        public void ClothStaysOutsideOfProps()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (var cloth = new Cloth(avatar, garment))
            using (Prop ball = Prop.Sphere(Context, 0.2f))
            using (Prop box = Prop.Box(Context, new Float3(0.1f, 0.1f, 0.1f)))
            using (Prop rod = Prop.Capsule(Context, 0.02f, 0.3f))
            {
                cloth.Step(1 / 60f);
                ulong alone = cloth.StateHash();
                foreach (Prop prop in new[] { ball, box, rod })
                {
                    prop.Move(new Float3(0.4f, 0.6f, 0), new Float4(0, 0, 0, 1));
                    cloth.AddProp(prop);
                }
                cloth.RemoveProp(rod);
                for (int i = 0; i < 30; i++) cloth.Step(1 / 60f);
                Assert.AreNotEqual(alone, cloth.StateHash());
                Assert.That(Cloth.CheckOutfit(cloth).Select(c => c.Kind), Has.No.Member(CrossingKind.Prop));

                var corners = new[]
                {
                    new Float3(0, 0, 0), new Float3(0.1f, 0, 0), new Float3(0, 0.1f, 0),
                    new Float3(0, 0, 0.1f)
                };
                var outside = new uint[] { 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3 };
                var inside = new uint[] { 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0 };
                using (Prop mesh = Prop.Mesh(Context, corners, outside))
                {
                    mesh.Deform(corners);
                    Assert.Throws<VfitException>(() => mesh.Deform(new Float3[3]));
                }
                Assert.Throws<VfitException>(() => Prop.Mesh(Context, corners, inside));
                Assert.Throws<ArgumentNullException>(() => Prop.Mesh(Context, null, outside));
                ball.Dispose();
                cloth.Step(1 / 60f);
            }
        }

        [Test]
        public void ARecordingPlaysWhatWasRecorded()
        {
            using (var live = new Sensor(Context, Support.Person))
            using (var played = new Sensor(Context, Support.Recording()))
            using (var a = new Frame(Context))
            using (var b = new Frame(Context))
            {
                live.Start();
                played.Start();
                var first = new ushort[320 * 240];
                var second = new ushort[320 * 240];
                for (int i = 0; i < 5; i++)
                {
                    Assert.AreEqual(Result.Ok, live.Acquire(a, -1));
                    Assert.AreEqual(Result.Ok, played.Acquire(b, -1));
                    a.Write(StreamKind.Depth, first);
                    b.Write(StreamKind.Depth, second);
                    CollectionAssert.AreEqual(first, second);
                    Assert.AreEqual(a.Bodies().Length, b.Bodies().Length);
                    Assert.AreEqual(a.Joints(1).Select(j => j.Id), b.Joints(1).Select(j => j.Id));
                }
            }
        }

        [Test]
        public void TheEndOfAStreamIsNewsAndLeavesTheFrameEmpty()
        {
            using (var sensor = new Sensor(Context, "virtual:frames=1&sensor=kinect_v1_320"))
            using (var frame = new Frame(Context))
            {
                sensor.Start();
                Assert.AreEqual(Result.Ok, sensor.Acquire(frame, -1));
                Assert.IsFalse(frame.IsEmpty);
                Assert.AreEqual(Result.EndOfStream, sensor.Acquire(frame, -1));
                Assert.IsTrue(frame.IsEmpty);
                Assert.AreEqual(Result.EndOfStream, sensor.Stats().State);
            }
        }

        [Test]
        public void RealRecordingsAreMeasured()
        {
            foreach (string folder in Support.RealRecordings().Take(3))
                using (var sensor = new Sensor(Context, "recording:" + folder))
                using (var tracker = new Tracker(Context))
                using (var scan = new Scan(Context, new ScanDesc { FrameCount = 5 }))
                {
                    foreach (Frame frame in sensor.Frames())
                    {
                        tracker.Update(frame, frame);
                        if (scan.Add(frame) == Result.Ok) break;
                    }
                    Measurement stature;
                    Assert.IsTrue(Measurements.TryFind(scan.Measure(), "stature_m", out stature));
                    Assert.That(stature.Value, Is.InRange(1.2f, 2.2f), folder);
                }
        }

        [Test]
        public void PosesAndBodiesGoOverTheNetwork()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (var other = new Context(new ContextOptions { Axes = Axes.Unity }))
            {
                BodyPose pose = BodyPose.Rest(new Float3(0.5f, 1, 0));
                Support.Turn(pose, 7);
                var packet = new byte[200];
                int length = pose.Pack(Context, packet);
                Assert.That(length, Is.InRange(1, 120));
                var back = new BodyPose();
                back.Unpack(other, packet, length);
                Assert.AreEqual(-0.5f, back.Bones[0].Position.X, 1e-3f, "Unity's x is turned round");
                Assert.AreEqual(pose.Bones[7].Rotation.W, back.Bones[7].Rotation.W, 1e-3f);
                Assert.AreEqual(
                    Result.ErrorData, Support.CodeOf(() => back.Unpack(other, packet, length / 2)));
                Assert.AreEqual(Result.ErrorCapacity, Support.CodeOf(() => pose.Pack(Context, new byte[0])));

                byte[] body = avatar.Pack("M");
                Assert.That(body.Length, Is.InRange(1, 240));
                string label;
                using (Avatar unpacked = Avatar.Unpack(other, body, out label))
                {
                    Assert.AreEqual("M", label);
                    Assert.AreEqual(avatar.Describe().VertexCount, unpacked.Describe().VertexCount);
                }
            }
        }

        [Test]
        public void JointsAloneMoveTheStageAndPosesGoToOtherPrograms()
        {
            var joints = new[]
            {
                Seen(JointId.LeftShoulder, 0.2f, 1.4f), Seen(JointId.RightShoulder, -0.2f, 1.4f),
                Seen(JointId.LeftHip, 0.1f, 0.9f), Seen(JointId.RightHip, -0.1f, 0.9f)
            };
            using (var motion = new Motion(Context))
            {
                var poses = new[] { new BodyPose(), new BodyPose() };
                for (int i = 0; i < 2; i++)
                {
                    var body = new Body { BodyId = 1, TimeNs = 100000000L * (i + 1) };
                    Assert.AreEqual(Result.Ok, motion.Step(body, joints, joints.Length, body.TimeNs));
                    motion.Pose(poses[i]);
                }
                Assert.AreEqual(
                    Result.NotReady, motion.Step(new Body { BodyId = 2, TimeNs = 9 }, joints, 1, 9));

                var packet = new byte[2048];
                foreach (Osc kind in new[] { Osc.Vmc, Osc.Vrchat })
                {
                    int length = poses[1].WriteOsc(Context, kind, packet);
                    Assert.That(length, Is.InRange(1000, 2048));
                    Assert.AreEqual("#bundle", Encoding.ASCII.GetString(packet, 0, 7));
                    string wanted = kind == Osc.Vmc ? "LeftUpperArm" : "/tracking/trackers/head/position";
                    Assert.IsTrue(Encoding.ASCII.GetString(packet, 0, length).Contains(wanted));
                }
                Assert.AreEqual(
                    Result.ErrorCapacity,
                    Support.CodeOf(() => poses[1].WriteOsc(Context, Osc.Vmc, new byte[0])));
                Assert.AreEqual(
                    Result.ErrorData,
                    Support.CodeOf(
                        () => BodyPose.Rest(new Float3(0, 1, 0)).WriteOsc(Context, Osc.Vmc, packet)));

                string text = BodyPose.Bvh(Context, poses, 0.05f);
                Assert.IsTrue(text.StartsWith("HIERARCHY\nROOT Hips\n"));
                Assert.IsTrue(text.Contains("\nFrames: 3\n"));
                Assert.AreEqual(
                    Result.ErrorData,
                    Support.CodeOf(() => BodyPose.Bvh(Context, new[] { poses[1], poses[0] })));
                Assert.AreEqual(
                    Result.ErrorArgument, Support.CodeOf(() => BodyPose.Bvh(Context, new BodyPose[0])));
            }
        }

        private static Joint Seen(JointId id, float x, float y)
        {
            return new Joint
            {
                Id = id, State = JointState.Measured, Confidence = 1, Position = new Float3(x, y, -2)
            };
        }

        [Test]
        public void MeasurementsAreKeptReadAndMerged()
        {
            var list = new[]
            {
                Measurements.Known("stature_m", 1.7f, 0.01f), Measurements.Known("chest_girth_m", 0.9f, 0.02f)
            };
            string text = Measurements.Write(list, Sex.Female);
            Sex sex;
            Measurement[] back = Measurements.Read(text, out sex);
            Assert.AreEqual(Sex.Female, sex);
            Assert.AreEqual(list.Select(m => m.Key), back.Select(m => m.Key));
            Assert.AreEqual(2, Measurements.Merge(list, back).Length);
            Assert.AreEqual(0, Measurements.Read("{}", out sex).Length);
            Assert.AreEqual(0, Measurements.Merge(new Measurement[0], new Measurement[0]).Length);
            Assert.AreEqual(Result.ErrorData, Support.CodeOf(() => Measurements.Read("{", out sex)));
        }

        [Test]
        public void ScansAreCalibratedToATape()
        {
            string calibration = null;
            for (int i = 0; i < 40; ++i)
                calibration = Measurements.AddToCalibration(
                    calibration, new[] { Measurements.Known("waist_girth_m", 0.8f, 0.01f) },
                    new[] { Measurements.Known("waist_girth_m", 0.82f + 0.001f * (i % 5)) });
            CalibratedMeasure[] told = Measurements.Calibrated(calibration);
            Assert.AreEqual(1, told.Length);
            Assert.AreEqual("waist_girth_m", told[0].Key);
            Assert.AreEqual(40, told[0].People);
            Assert.AreEqual(0.022f, told[0].Offset, 0.001f);
            Measurement[] scan = Measurements.Calibrate(
                calibration, new[] { Measurements.Known("waist_girth_m", 0.9f, 0.01f) });
            Assert.AreEqual(0.922f, scan[0].Value, 0.001f);
            Assert.Less(scan[0].Sigma, 0.005f);
            Assert.AreEqual(Result.ErrorData, Support.CodeOf(() => Measurements.Calibrated("{}")));
        }

        [Test]
        public void AllMeasuresFollowFromThoseThatAPersonKnows()
        {
            Assert.That(Population.List(Context).Select(p => p.Name), Has.Member("adults"));
            using (Population adults = Population.Open(Context, "adults"))
            {
                Measurement[] all = adults.Estimate(
                    new[] { Measurements.Known("stature_m", 1.7f), Measurements.Known("body_mass_kg", 65f) },
                    Sex.Female, 40f);
                Assert.That(all.Select(m => m.Key), Has.Member("hip_girth_m"));
                Doubt[] doubts = adults.Check(
                    new[]
                    {
                        Measurements.Known("stature_m", 1.7f), Measurements.Known("body_mass_kg", 65f),
                        Measurements.Known("waist_girth_m", 0.30f), Measurements.Known("hip_girth_m", 1.0f)
                    },
                    Sex.Female);
                Assert.AreEqual(1, doubts.Length);
                Assert.AreEqual("waist_girth_m", doubts[0].Key);
                Assert.AreEqual(DoubtKind.Inches, doubts[0].Kind);
                Assert.AreEqual(0.762f, doubts[0].Suggested, 0.001f);
                Assert.AreEqual(
                    Result.ErrorArgument, Support.CodeOf(() => adults.Estimate(all, Sex.Female, 7f)));
            }
            Assert.AreEqual(Result.ErrorData, Support.CodeOf(() => Population.Load(Context, "{}")));
        }

        [Test]
        public void ABodyIsShapedMeasuredAndTakenApart()
        {
            ShapeValue[] shapes = Context.Shapes();
            Assert.Greater(shapes.Length, 100);
            var heavy = new[] { new ShapeValue { Key = "weight", Value = 0.9f } };
            using (Avatar avatar = Avatar.FromShape(Context, heavy))
            {
                Assert.Greater(avatar.Measure().Length, 10);
                Assert.That(avatar.Rig().Select(b => b.Name), Has.No.Member(""));
                Assert.AreEqual(1, avatar.Parts().Length);
                Assert.AreEqual(CharacterKind.Body, avatar.Describe().Kind);
                Assert.AreEqual(1.0f, avatar.Describe().FromFile[0, 0]);
                avatar.Pose(BodyPose.Rest(new Float3(0, 1, 0)));
                Assert.AreEqual(Counts.JointCount, avatar.Joints().Length);
                Assert.Greater(avatar.Colliders(new Collider[64]), 10);
                using (var mesh = new Frame(Context))
                {
                    avatar.AcquireRest(mesh);
                    Assert.That(mesh.Streams(), Has.Member(StreamKind.SkinWeights));
                    var weights = new float[mesh.Count(StreamKind.SkinWeights) * 8];
                    mesh.Write(StreamKind.SkinWeights, weights);
                    Assert.AreEqual(1, weights.Take(8).Sum(), 1e-3f);
                    var bones = new ushort[weights.Length];
                    mesh.Write(StreamKind.SkinBones, bones);
                    Assert.Less(bones.Max(), avatar.Describe().BoneCount);
                }
            }
        }

        [Test]
        public void TheSkinGoesStraightIntoAnArray()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (var mesh = new Frame(Context))
            {
                BodyPose pose = BodyPose.Rest(new Float3(0, 1, 0));
                avatar.Pose(pose);
                avatar.Acquire(mesh);
                var wanted = new Float3[mesh.Count(StreamKind.Position)];
                var positions = new Float3[wanted.Length];
                var normals = new Float3[wanted.Length];
                mesh.Write(StreamKind.Position, wanted);
                avatar.PoseInto(pose, positions, normals);
                CollectionAssert.AreEqual(wanted, positions);
                Assert.AreEqual(
                    Result.ErrorCapacity, Support.CodeOf(() => avatar.PoseInto(pose, new Float3[10], null)));
            }
        }

        [Test]
        public void OwnCharactersAreReadAndRefusedWithTheCause()
        {
            string nobody = Path.Combine(Support.TemporaryFolder(), "nobody.gltf");
            File.WriteAllText(nobody, "{\"asset\": {\"version\": \"2.0\"}}");
            Assert.AreEqual(Result.ErrorData, Support.CodeOf(() => Avatar.Load(Context, nobody)));
            byte[] bytes = File.ReadAllBytes(nobody);
            Assert.AreEqual(Result.ErrorData, Support.CodeOf(() => Avatar.Load(Context, bytes)));
            Assert.AreEqual(Result.ErrorIo, Support.CodeOf(() => Avatar.Load(Context, nobody + ".vrm")));
            Assert.AreEqual(0u, Context.Stats().HandleCount);
        }

        [Test]
        public void UnityAxesTurnXRound()
        {
            using (var unity = new Context(new ContextOptions { Axes = Axes.Unity }))
            using (Avatar a = Support.MakeAvatar(Context), b = Support.MakeAvatar(unity))
            using (Frame right = new Frame(Context), left = new Frame(unity))
            {
                a.AcquireRest(right);
                b.AcquireRest(left);
                var p = new Float3[right.Count(StreamKind.Position)];
                var q = new Float3[p.Length];
                right.Write(StreamKind.Position, p);
                left.Write(StreamKind.Position, q);
                for (int i = 0; i < p.Length; i += 97)
                {
                    Assert.AreEqual(p[i].X, -q[i].X, 1e-6f);
                    Assert.AreEqual(p[i].Z, q[i].Z, 1e-6f);
                }
            }
        }
    }
}
