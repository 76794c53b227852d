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
