// A pose: the bones of a humanoid and which feet stand. One object is filled again and again.
using System;

namespace Vfit
{
    public sealed unsafe class BodyPose
    {
        /// <summary>Time, contacts, what the foot stage moved.</summary>
        public Pose Info;
        /// <summary>One a BoneId, parents before children; only the first Count are given.</summary>
        public readonly Bone[] Bones = new Bone[Counts.BoneCount];
        public int Count;

        /// <summary>The rest pose at that place of the hips.</summary>
        public static BodyPose Rest(Float3 hips)
        {
            var pose = new BodyPose { Count = Counts.BoneCount };
            for (int i = 0; i < pose.Count; i++)
            {
                pose.Bones[i].Id = (BoneId)i;
                pose.Bones[i].Rotation = new Float4(0, 0, 0, 1);
            }
            pose.Bones[0].Position = hips;
            return pose;
        }

        /// <summary>For the network: writes at most 120 bytes into the array and returns how many.</summary>
        public int Pack(Context context, byte[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            uint count = (uint)into.Length;
            byte none;
            fixed (byte* array = into)
            fixed (Bone* bones = Bones)
            {
                Pose info = Header();
                Calls.PosePack(
                    Context.Of(context, "context"), &info, bones, (uint)sizeof(Bone), CheckedCount(),
                    array == null ? &none : array, &count);
            }
            return (int)count;
        }

        /// <summary>Reads a packet from any axes. Positions of all bones except the hips are zero.</summary>
        public void Unpack(Context context, byte[] packet, int length)
        {
            Arrays.Check(packet, length, "packet");
            fixed (byte* bytes = packet)
            fixed (Bone* bones = Bones)
            {
                Pose info = Header();
                uint count = Counts.BoneCount;
                Calls.PoseUnpack(
                    Context.Of(context, "context"), bytes, (uint)length, &info, bones, (uint)sizeof(Bone),
                    &count);
                Info = info;
                Count = (int)count;
            }
        }

        /// <summary>
        /// One UDP packet of Open Sound Control: writes at most 2,048 bytes and returns how many. All bones
        /// are needed, as Motion.Pose gives them.
        /// </summary>
        public int WriteOsc(Context context, Osc kind, byte[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            uint count = (uint)into.Length;
            byte none;
            fixed (byte* array = into)
            fixed (Bone* bones = Bones)
            {
                Pose info = Header();
                Calls.PoseOsc(
                    Context.Of(context, "context"), &info, bones, (uint)sizeof(Bone), CheckedCount(), kind,
                    array == null ? &none : array, &count);
            }
            return (int)count;
        }

        /// <summary>
        /// A motion as the text of a BVH file. All bones of each pose are needed; times increase.
        /// frameTimeS 0: 1/30 s.
        /// </summary>
        public static string Bvh(Context context, BodyPose[] motion, float frameTimeS = 0)
        {
            Arrays.Check(motion, 0, "motion");
            var infos = new Pose[motion.Length];
            var all = new Bone[motion.Length * Counts.BoneCount];
            for (int i = 0; i < motion.Length; i++)
            {
                if (motion[i] == null) throw new ArgumentNullException("motion[" + i + "]");
                if (motion[i].Count != Counts.BoneCount)
                    throw new ArgumentException(
                        "motion[" + i + "] has " + motion[i].Count + " bones", "motion");
                infos[i] = motion[i].Header();
                Array.Copy(motion[i].Bones, 0, all, i * Counts.BoneCount, Counts.BoneCount);
            }
            uint capacity = 0;
            fixed (Pose* poses = infos)
            fixed (Bone* bones = all)
            {
                Calls.PoseBvh(
                    Context.Of(context, "context"), poses, (uint)sizeof(Pose), (uint)infos.Length, bones,
                    (uint)sizeof(Bone), (uint)all.Length, frameTimeS, null, &capacity);
                var text = new byte[capacity];
                fixed (byte* bytes = text)
                {
                    Calls.PoseBvh(
                        Context.Of(context, "context"), poses, (uint)sizeof(Pose), (uint)infos.Length, bones,
                        (uint)sizeof(Bone), (uint)all.Length, frameTimeS, bytes, &capacity);
                    return Utf8Text.Read(bytes, text.Length);
                }
            }
        }

        internal Pose Header()
        {
            Pose info = Info;
            info.StructSize = (uint)sizeof(Pose);
            return info;
        }

        internal uint CheckedCount()
        {
            if (Count < 0 || Count > Counts.BoneCount)
                throw new ArgumentOutOfRangeException(
                    "Count", "Count " + Count + " of " + Counts.BoneCount + " bones");
            return (uint)Count;
        }
    }
}
