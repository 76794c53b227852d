// A tracker: people and their joints in a frame, by itself, from the source, or from middleware of the host.
using System;

namespace Vfit
{
    public sealed unsafe class Tracker : VfitObject<TrackerHandle>
    {
        public Context Context { get; private set; }

        public Tracker(Context context, TrackerDesc desc = default(TrackerDesc), Camera? floor = null)
            : base(new TrackerHandle(Context.Of(context, "context")))
        {
            Context = context;
            Camera camera = floor.GetValueOrDefault();
            camera.StructSize = (uint)sizeof(Camera);
            desc.StructSize = (uint)sizeof(TrackerDesc);
            desc.floor = floor.HasValue ? &camera : null;
            Calls.TrackerCreate(context.Handle, &desc, Handle);
        }

        /// <summary>
        /// The frame with its bodies; both may be one object, which gets the tracked frame.
        /// </summary>
        public void Update(Frame frame, Frame tracked)
        {
            Calls.TrackerUpdate(Handle, Frame.Of(frame, "frame"), Frame.Of(tracked, "tracked"));
        }

        /// <summary>
        /// Joints of the host's own middleware, one call per body. For a second body, pass the frame that the
        /// first call made.
        /// </summary>
        public void Submit(Frame frame, Body body, Joint[] joints, int count, Frame tracked)
        {
            Arrays.Check(joints, count, "joints");
            body.StructSize = (uint)sizeof(Body);
            fixed (Joint* items = joints)
                Calls.TrackerSubmit(
                    Handle, Frame.Of(frame, "frame"), &body, items, (uint)sizeof(Joint), (uint)count,
                    Frame.Of(tracked, "tracked"));
        }

        /// <summary>For the next update: where a network of the host's sees joints in the picture.</summary>
        public void Hint(JointHint[] hints, int count)
        {
            Arrays.Check(hints, count, "hints");
            fixed (JointHint* items = hints)
                Calls.TrackerHint(Handle, items, (uint)sizeof(JointHint), (uint)count);
        }

        /// <summary>
        /// For the next update: a person as the tracker of another camera saw them, which tells which way
        /// they face. position and rotation: its world space in this one's (Context.AlignWorlds).
        /// </summary>
        public void HintFrom(Frame seen, uint bodyId, Float3 position, Float4 rotation)
        {
            Calls.TrackerHintFrom(Handle, Frame.Of(seen, "seen"), bodyId, &position.X, &rotation.X);
        }

        /// <summary>Forgets people, room and choice.</summary>
        public void Reset()
        {
            Calls.TrackerReset(Handle);
        }

        /// <summary>That person is the active one from the next update on; 0: by the rule again.</summary>
        public void SetActive(uint bodyId)
        {
            Calls.TrackerSetActive(Handle, bodyId);
        }
    }
}
