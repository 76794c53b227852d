// An avatar: a body or a character that takes poses and gives its skin, bones and colliders.
using System;

namespace Vfit
{
    public sealed unsafe partial class Avatar : VfitObject<AvatarHandle>
    {
        public Context Context { get; private set; }

        private Avatar(Context context) : base(new AvatarHandle(Context.Of(context, "context")))
        {
            Context = context;
        }

        public CharacterInfo Describe()
        {
            return Calls.AvatarDescribe(Handle);
        }

        /// <summary>Triangles of each material.</summary>
        public AvatarPart[] Parts()
        {
            return Calls.AvatarParts(Handle);
        }

        public RigBone[] Rig()
        {
            return Calls.AvatarRig(Handle);
        }

        public void Pose(BodyPose pose)
        {
            if (pose == null) throw new ArgumentNullException("pose");
            Pose info = pose.Header();
            fixed (Bone* bones = pose.Bones)
                Calls.AvatarPose(Handle, &info, bones, (uint)sizeof(Bone), pose.CheckedCount());
        }

        /// <summary>
        /// The same, and writes the skin into memory of the engine: vertexCount vertices of three floats,
        /// stride bytes apart (0: packed). normals may be zero.
        /// </summary>
        public void PoseInto(BodyPose pose, IntPtr positions, IntPtr normals, int vertexCount, int stride)
        {
            if (pose == null) throw new ArgumentNullException("pose");
            if (vertexCount < 0) throw new ArgumentOutOfRangeException("vertexCount");
            Pose info = pose.Header();
            long step = stride == 0 ? sizeof(Float3) : stride;
            long capacity = vertexCount == 0 ? 0 : (vertexCount - 1) * step + sizeof(Float3);
            Target places = Target.At((void*)positions, capacity, Format.F32x3, stride);
            Target directions = Target.At((void*)normals, capacity, Format.F32x3, stride);
            fixed (Bone* bones = pose.Bones)
                Calls.AvatarPoseInto(Handle, &info, bones, (uint)sizeof(Bone), pose.CheckedCount(), &places,
                                     normals == IntPtr.Zero ? null : &directions);
        }

        /// <summary>The same into arrays; normals may be null.</summary>
        public void PoseInto(BodyPose pose, Float3[] positions, Float3[] normals)
        {
            Arrays.Check(positions, 0, "positions");
            if (normals != null && normals.Length != positions.Length)
                throw new ArgumentException("as many normals as positions", "normals");
            fixed (Float3* p = positions, n = normals)
                PoseInto(pose, (IntPtr)p, (IntPtr)n, positions.Length, 0);
        }

        public Collider[] Colliders()
        {
            return Calls.AvatarColliders(Handle);
        }

        public int Colliders(Collider[] into)
        {
            return Calls.AvatarColliders(Handle, into);
        }

        /// <summary>Every joint of the posed avatar, at its true place.</summary>
        public Joint[] Joints()
        {
            return Calls.AvatarJoints(Handle);
        }

        public int Joints(Joint[] into)
        {
            return Calls.AvatarJoints(Handle, into);
        }

        /// <summary>Tape measures of the avatar's own body.</summary>
        public Measurement[] Measure()
        {
            return Calls.AvatarMeasure(Handle);
        }

        /// <summary>Measures of one's own as JSON (docs/measuring.md).</summary>
        public Measurement[] MeasureOwn(string json)
        {
            byte[] text = Utf8Text.Encode(json, "json");
            fixed (byte* bytes = text) return Calls.AvatarMeasureOwn(Handle, bytes, (ulong)text.Length - 1);
        }

        /// <summary>The posed mesh: positions, normals, uv, indices, bone matrices, skin weights.</summary>
        public void Acquire(Frame into)
        {
            Calls.AvatarAcquire(Handle, Frame.Of(into, "into"));
        }

        /// <summary>The same streams of the unposed mesh.</summary>
        public void AcquireRest(Frame into)
        {
            Calls.AvatarAcquireRest(Handle, Frame.Of(into, "into"));
        }

        /// <summary>The body and its size for the network, at most 240 bytes.</summary>
        public byte[] Pack(string sizeLabel)
        {
            uint count = 0;
            fixed (byte* label = Utf8Text.Encode(sizeLabel))
            {
                Calls.AvatarPack(Handle, label, null, &count);
                var packet = new byte[count];
                fixed (byte* bytes = packet) Calls.AvatarPack(Handle, label, bytes, &count);
                return packet;
            }
        }
    }
}
