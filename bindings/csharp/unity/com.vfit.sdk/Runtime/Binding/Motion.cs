// Motion: raw bodies in, clean poses out.
namespace Vfit
{
    public sealed unsafe class Motion : VfitObject<MotionHandle>
    {
        public Context Context { get; private set; }

        /// <summary>rangeOfMotion: null, or joint limits as JSON (docs/motion.md).</summary>
        public Motion(Context context, MotionDesc desc = default(MotionDesc), string rangeOfMotion = null)
            : base(new MotionHandle(Context.Of(context, "context")))
        {
            Context = context;
            fixed (byte* limits = Utf8Text.Encode(rangeOfMotion))
            {
                desc.StructSize = (uint)sizeof(MotionDesc);
                desc.rangeOfMotion = limits;
                Calls.MotionCreate(context.Handle, &desc, Handle);
            }
        }

        public void Reset()
        {
            Calls.MotionReset(Handle);
        }

        /// <summary>Plants the feet with that avatar's legs.</summary>
        public void Bind(Avatar avatar)
        {
            Calls.MotionBind(Handle, Avatar.Of(avatar, "avatar"));
        }

        /// <summary>
        /// Takes a new body, or predicts to nowNs if the frame is the same or null. NotReady: that body is
        /// not in the frame, and the pose holds.
        /// </summary>
        public Result Step(Frame tracked, uint bodyId, long nowNs)
        {
            // An empty frame is the library's null frame.
            return Calls.MotionStep(Handle, tracked == null ? null : tracked.Handle, bodyId, nowNs);
        }

        /// <summary>
        /// Joints of your own in world space, without a frame. NotReady: they do not place the trunk.
        /// </summary>
        public Result Step(Body body, Joint[] joints, int count, long nowNs)
        {
            Arrays.Check(joints, count, "joints");
            body.StructSize = (uint)sizeof(Body);
            fixed (Joint* items = joints)
                return Calls.MotionStepBody(
                    Handle, &body, items, (uint)sizeof(Joint), (uint)count, nowNs);
        }

        /// <summary>Filtered and smoothed; ErrorState before the first body.</summary>
        public void Pose(BodyPose into)
        {
            if (into == null) throw new System.ArgumentNullException("into");
            Pose info = into.Header();
            uint count = Counts.BoneCount;
            fixed (Bone* bones = into.Bones)
                Calls.MotionPose(Handle, &info, bones, (uint)sizeof(Bone), &count);
            into.Info = info;
            into.Count = (int)count;
        }

        /// <summary>The filtered joints behind the pose, feet corrected.</summary>
        public int Joints(Joint[] into)
        {
            return Calls.MotionJoints(Handle, into);
        }

        public Joint[] Joints()
        {
            return Calls.MotionJoints(Handle);
        }
    }
}
