// A humanoid with bone axes of its own stands as vfit's own avatar does.
using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using Vfit.Tests;

namespace Vfit.Unity.Tests
{
    /// <summary>A character in a T-pose that faces +Z; each bone has its own rotation, as in files.</summary>
    internal static class StandInHumanoid
    {
        private static readonly Dictionary<HumanBodyBones, Vector3> places =
            new Dictionary<HumanBodyBones, Vector3>
        {
            { HumanBodyBones.Hips, new Vector3(0, 1.0f, 0) },
            { HumanBodyBones.Spine, new Vector3(0, 1.1f, 0) },
            { HumanBodyBones.Chest, new Vector3(0, 1.25f, 0) },
            { HumanBodyBones.Neck, new Vector3(0, 1.5f, 0) },
            { HumanBodyBones.Head, new Vector3(0, 1.6f, 0) },
            { HumanBodyBones.LeftShoulder, new Vector3(-0.05f, 1.45f, 0) },
            { HumanBodyBones.LeftUpperArm, new Vector3(-0.2f, 1.45f, 0) },
            { HumanBodyBones.LeftLowerArm, new Vector3(-0.5f, 1.45f, 0) },
            { HumanBodyBones.LeftHand, new Vector3(-0.75f, 1.45f, 0) },
            { HumanBodyBones.RightShoulder, new Vector3(0.05f, 1.45f, 0) },
            { HumanBodyBones.RightUpperArm, new Vector3(0.2f, 1.45f, 0) },
            { HumanBodyBones.RightLowerArm, new Vector3(0.5f, 1.45f, 0) },
            { HumanBodyBones.RightHand, new Vector3(0.75f, 1.45f, 0) },
            { HumanBodyBones.LeftUpperLeg, new Vector3(-0.1f, 0.95f, 0) },
            { HumanBodyBones.LeftLowerLeg, new Vector3(-0.1f, 0.52f, 0) },
            { HumanBodyBones.LeftFoot, new Vector3(-0.1f, 0.09f, 0) },
            { HumanBodyBones.RightUpperLeg, new Vector3(0.1f, 0.95f, 0) },
            { HumanBodyBones.RightLowerLeg, new Vector3(0.1f, 0.52f, 0) },
            { HumanBodyBones.RightFoot, new Vector3(0.1f, 0.09f, 0) }
        };

        private static readonly HumanBodyBones[,] parents =
        {
            { HumanBodyBones.Spine, HumanBodyBones.Hips },
            { HumanBodyBones.Chest, HumanBodyBones.Spine },
            { HumanBodyBones.Neck, HumanBodyBones.Chest },
            { HumanBodyBones.Head, HumanBodyBones.Neck },
            { HumanBodyBones.LeftShoulder, HumanBodyBones.Chest },
            { HumanBodyBones.LeftUpperArm, HumanBodyBones.LeftShoulder },
            { HumanBodyBones.LeftLowerArm, HumanBodyBones.LeftUpperArm },
            { HumanBodyBones.LeftHand, HumanBodyBones.LeftLowerArm },
            { HumanBodyBones.RightShoulder, HumanBodyBones.Chest },
            { HumanBodyBones.RightUpperArm, HumanBodyBones.RightShoulder },
            { HumanBodyBones.RightLowerArm, HumanBodyBones.RightUpperArm },
            { HumanBodyBones.RightHand, HumanBodyBones.RightLowerArm },
            { HumanBodyBones.LeftUpperLeg, HumanBodyBones.Hips },
            { HumanBodyBones.LeftLowerLeg, HumanBodyBones.LeftUpperLeg },
            { HumanBodyBones.LeftFoot, HumanBodyBones.LeftLowerLeg },
            { HumanBodyBones.RightUpperLeg, HumanBodyBones.Hips },
            { HumanBodyBones.RightLowerLeg, HumanBodyBones.RightUpperLeg },
            { HumanBodyBones.RightFoot, HumanBodyBones.RightLowerLeg }
        };

        internal static Animator Make(bool bentBeforeUse)
        {
            var owner = new GameObject("hero");
            Animator animator = owner.AddComponent<Animator>();
            var random = new System.Random(5);
            Add(animator, HumanBodyBones.Hips, new GameObject("armature").transform, owner.transform, random);
            for (int i = 0; i < parents.GetLength(0); i++)
                Add(animator, parents[i, 0], animator.bones[parents[i, 1]], null, random);
            var skeleton = new List<SkeletonBone>();
            foreach (Transform bone in animator.bones.Values)
                skeleton.Add(new SkeletonBone
                {
                    name = bone.name, position = bone.localPosition, rotation = bone.localRotation,
                    scale = bone.localScale
                });
            var description = new HumanDescription { skeleton = skeleton.ToArray() };
            animator.avatar = new UnityEngine.Avatar { isHuman = true, humanDescription = description };
            if (bentBeforeUse)
                foreach (Transform bone in animator.bones.Values)
                    bone.localRotation = Turn(random) * bone.localRotation;
            return animator;
        }

        private static void Add(
            Animator animator, HumanBodyBones name, Transform parent, Transform above, System.Random random)
        {
            if (above != null)
            {
                parent.parent = above;
                parent.localRotation = Turn(random);
                parent.localScale = new Vector3(0.01f, 0.01f, 0.01f);   // centimetres, as Mixamo has it
            }
            Transform bone = new GameObject(name.ToString()).transform;
            bone.parent = parent;
            bone.position = places[name];
            bone.rotation = Turn(random);
            animator.bones[name] = bone;
        }

        private static Quaternion Turn(System.Random random)
        {
            double x = random.NextDouble() - 0.5, y = random.NextDouble() - 0.5;
            double z = random.NextDouble() - 0.5, w = random.NextDouble();
            double n = Math.Sqrt(x * x + y * y + z * z + w * w);
            return new Quaternion((float)(x / n), (float)(y / n), (float)(z / n), (float)(w / n));
        }
    }

    [TestFixture]
    public class HumanoidDriverTests
    {
        private static readonly JointId[,] limbs =
        {
            { JointId.LeftElbow, JointId.LeftWrist }, { JointId.RightElbow, JointId.RightWrist },
            { JointId.LeftShoulder, JointId.LeftElbow }, { JointId.RightShoulder, JointId.RightElbow },
            { JointId.LeftHip, JointId.LeftKnee }, { JointId.RightHip, JointId.RightKnee },
            { JointId.LeftKnee, JointId.LeftFoot }, { JointId.RightKnee, JointId.RightFoot }
        };

        private static readonly HumanBodyBones[,] bones =
        {
            { HumanBodyBones.LeftLowerArm, HumanBodyBones.LeftHand },
            { HumanBodyBones.RightLowerArm, HumanBodyBones.RightHand },
            { HumanBodyBones.LeftUpperArm, HumanBodyBones.LeftLowerArm },
            { HumanBodyBones.RightUpperArm, HumanBodyBones.RightLowerArm },
            { HumanBodyBones.LeftUpperLeg, HumanBodyBones.LeftLowerLeg },
            { HumanBodyBones.RightUpperLeg, HumanBodyBones.RightLowerLeg },
            { HumanBodyBones.LeftLowerLeg, HumanBodyBones.LeftFoot },
            { HumanBodyBones.RightLowerLeg, HumanBodyBones.RightFoot }
        };

        [TestCase(false)]
        [TestCase(true)]
        public void LimbsPointWhereThePersonsDo(bool mirror)
        {
            Animator hero = StandInHumanoid.Make(true);
            hero.transform.localRotation = new Quaternion(0, 0.6f, 0, 0.8f);
            hero.transform.localPosition = new Vector3(3, 0, 1);
            var driver = new HumanoidDriver(hero);
            var options = new ContextOptions
            {
                Axes = Axes.Unity, Flags = mirror ? ContextFlags.Mirror : ContextFlags.None
            };
            float worst = 0, lowest = 9;
            using (var context = new Context(options))
            using (var sensor = new Sensor(context, Support.Recording()))
            using (var tracker = new Tracker(context))
            using (var motion = new Motion(context))
            using (Vfit.Avatar avatar = Support.MakeAvatar(context))
            using (var tracked = new Frame(context))
            {
                motion.Bind(avatar);
                var pose = new BodyPose();
                var joints = new Joint[Counts.JointCount];
                int frames = 0;
                foreach (Frame frame in sensor.Frames())
                {
                    tracker.Update(frame, tracked);
                    long now = tracked.View(StreamKind.Depth).TimeNs;
                    if (motion.Step(tracked, tracked.ActiveBody(), now) != Result.Ok) continue;
                    motion.Pose(pose);
                    avatar.Pose(pose);
                    avatar.Joints(joints);
                    driver.Apply(pose);
                    for (int i = 0; i < limbs.GetLength(0); i++)
                    {
                        Vector3 limb = Place(joints, limbs[i, 1]) - Place(joints, limbs[i, 0]);
                        Vector3 wanted = hero.transform.rotation * limb;
                        Vector3 made = hero.bones[bones[i, 1]].position - hero.bones[bones[i, 0]].position;
                        worst = Math.Max(worst, Vector3.Angle(wanted, made));
                    }
                    lowest = Math.Min(lowest, hero.bones[HumanBodyBones.LeftFoot].position.y);
                    lowest = Math.Min(lowest, hero.bones[HumanBodyBones.RightFoot].position.y);
                    frames++;
                }
                Assert.Greater(frames, 30);
            }
            Console.WriteLine("humanoid: limbs at most " + worst.ToString("0.0") +
                              " degrees apart from the avatar's, lowest ankle at " + lowest.ToString("0.00") +
                              " m");
            // The avatar's own limbs are not quite straight in its T-pose, the stand-in's are.
            Assert.Less(worst, 15);
            Assert.That(lowest, Is.InRange(0.0f, 0.15f), "it stands on the floor");
        }

        [Test]
        public void AnEmptyPoseChangesNothing()
        {
            Animator hero = StandInHumanoid.Make(false);
            Quaternion before = hero.bones[HumanBodyBones.Head].rotation;
            new HumanoidDriver(hero).Apply(new BodyPose());
            Assert.AreEqual(before, hero.bones[HumanBodyBones.Head].rotation);
        }

        [Test]
        public void TheRestPoseIsTheCharactersTPose()
        {
            Animator hero = StandInHumanoid.Make(true), straight = StandInHumanoid.Make(false);
            new HumanoidDriver(hero).Apply(BodyPose.Rest(new Float3(0, 1, 0)));
            foreach (KeyValuePair<HumanBodyBones, Transform> bone in straight.bones)
                {
                    Vector3 apart = hero.bones[bone.Key].position - bone.Value.position;
                    Assert.Less(apart.magnitude, 1e-3f, bone.Key.ToString());
                }
        }

        private static Vector3 Place(Joint[] joints, JointId id)
        {
            Joint joint = Array.Find(joints, j => j.Id == id);
            return new Vector3(joint.Position.X, joint.Position.Y, joint.Position.Z);
        }
    }
}
