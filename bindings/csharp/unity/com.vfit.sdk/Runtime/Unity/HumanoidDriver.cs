// Poses of vfit on the bones of a Unity humanoid, whatever axes its bones have.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Vfit.Unity
{
    /// <summary>
    /// vfit's rotations are relative to a T-pose in which every bone has the axes of world space. They are
    /// applied to the character's bones in its own T-pose. The T-pose comes from the humanoid's avatar asset,
    /// so the character may have any pose when this is made. Bones that the character lacks pass their
    /// rotation on to their children.
    /// </summary>
    public sealed class HumanoidDriver
    {
        // In the order of BoneId.
        private static readonly HumanBodyBones[] names =
        {
            HumanBodyBones.Hips, HumanBodyBones.Spine, HumanBodyBones.Chest, HumanBodyBones.UpperChest,
            HumanBodyBones.Neck, HumanBodyBones.Head,
            HumanBodyBones.LeftShoulder, HumanBodyBones.LeftUpperArm, HumanBodyBones.LeftLowerArm,
            HumanBodyBones.LeftHand,
            HumanBodyBones.RightShoulder, HumanBodyBones.RightUpperArm, HumanBodyBones.RightLowerArm,
            HumanBodyBones.RightHand,
            HumanBodyBones.LeftUpperLeg, HumanBodyBones.LeftLowerLeg, HumanBodyBones.LeftFoot,
            HumanBodyBones.LeftToes,
            HumanBodyBones.RightUpperLeg, HumanBodyBones.RightLowerLeg, HumanBodyBones.RightFoot,
            HumanBodyBones.RightToes
        };

        private readonly Transform root;
        private readonly Transform[] bones = new Transform[Counts.BoneCount];
        // All in the space of root.
        private readonly Quaternion[] rest = new Quaternion[Counts.BoneCount];
        private readonly Quaternion[] turned = new Quaternion[Counts.BoneCount];
        private readonly int[] parents = new int[Counts.BoneCount];
        private readonly float hipsAboveFoot;

        public HumanoidDriver(Animator animator)
        {
            if (animator == null) throw new ArgumentNullException("animator");
            if (animator.avatar == null || !animator.avatar.isHuman)
                throw new ArgumentException(
                    "the animator " + animator.name + " has no humanoid avatar", "animator");
            root = animator.transform;
            Dictionary<string, SkeletonBone> tPose = TPose(animator);
            Vector3 hips = Vector3.zero, foot = Vector3.zero;
            for (int i = 0; i < bones.Length; i++)
            {
                parents[i] = Library.BoneParent((BoneId)i);
                bones[i] = animator.GetBoneTransform(names[i]);
                if (bones[i] == null) continue;
                Vector3 place;
                ToRoot(bones[i], tPose, out place, out rest[i]);
                if ((BoneId)i == BoneId.Hips) hips = place;
                if ((BoneId)i == BoneId.LeftFoot) foot = place;
            }
            hipsAboveFoot = hips.y - foot.y;
        }

        /// <summary>Turns the bones and carries the hips, scaled by the length of the legs.</summary>
        public void Apply(BodyPose pose)
        {
            if (pose.Count < bones.Length) return;
            Quaternion rootRotation = root.rotation;
            for (int i = 0; i < bones.Length; i++)
            {
                Float4 q = pose.Bones[i].Rotation;
                var local = new Quaternion(q.X, q.Y, q.Z, q.W);
                turned[i] = parents[i] < 0 ? local : turned[parents[i]] * local;
                if (bones[i] != null) bones[i].rotation = rootRotation * turned[i] * rest[i];
            }
            if (bones[0] == null) return;
            Float3 hips = pose.Bones[0].Position;
            float scale = LegScale(pose);
            var place = new Vector3(hips.X * scale, hips.Y * scale, hips.Z * scale);
            bones[0].position = root.TransformPoint(place);
        }

        /// <summary>
        /// Ratio of leg lengths, character to pose; positions of a pose are T-pose offsets.
        /// </summary>
        private float LegScale(BodyPose pose)
        {
            float leg = -(pose.Bones[(int)BoneId.LeftUpperLeg].Position.Y +
                          pose.Bones[(int)BoneId.LeftLowerLeg].Position.Y +
                          pose.Bones[(int)BoneId.LeftFoot].Position.Y);
            return leg > 0.1f && hipsAboveFoot > 0 ? hipsAboveFoot / leg : 1;
        }

        private static Dictionary<string, SkeletonBone> TPose(Animator animator)
        {
            var found = new Dictionary<string, SkeletonBone>();
            foreach (SkeletonBone bone in animator.avatar.humanDescription.skeleton) found[bone.name] = bone;
            return found;
        }

        /// <summary>Position and rotation of a bone in the T-pose, or now if the asset lacks it.</summary>
        private void ToRoot(
            Transform bone, Dictionary<string, SkeletonBone> tPose, out Vector3 place,
            out Quaternion rotation)
        {
            place = Vector3.zero;
            rotation = Quaternion.identity;
            for (Transform t = bone; t != null && t != root; t = t.parent)
            {
                SkeletonBone known;
                bool isKnown = tPose.TryGetValue(t.name, out known);
                Vector3 scale = isKnown ? known.scale : t.localScale;
                Quaternion turn = isKnown ? known.rotation : t.localRotation;
                place = (isKnown ? known.position : t.localPosition) + turn * Vector3.Scale(scale, place);
                rotation = turn * rotation;
            }
        }
    }
}
