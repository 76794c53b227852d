// A frame: images and bodies of a sensor, or the streams of a mesh. One object holds one frame after another.
using System;

namespace Vfit
{
    public sealed unsafe partial class Frame : VfitObject<FrameHandle>
    {
        /// <summary>Empty; Acquire, Update and others fill it. Make it once, outside of the loop.</summary>
        public Frame(Context context) : base(new FrameHandle(Context.Of(context, "context"))) { }

        public bool IsEmpty
        {
            get { return Handle.IsEmpty; }
        }

        /// <summary>Gives the frame back now and empties this object; pools of frames are bounded.</summary>
        public void Clear()
        {
            Handle.Put(0);
        }

        /// <summary>The other object holds this frame too, for example for another thread.</summary>
        public void Share(Frame with)
        {
            FrameHandle other = Of(with, "with");
            bool held = false;
            try
            {
                ulong id = VfitHandle.Hold(Handle, ref held);
                VfitException.Check(Native.vfit_frame_retain(new FrameId(id)));
                other.Put(id);
            }
            finally
            {
                if (held) Handle.DangerousRelease();
            }
        }

        public StreamKind[] Streams()
        {
            return Calls.FrameStreams(Handle);
        }

        /// <summary>A stream in memory, valid until this object is filled, cleared or disposed.</summary>
        public View View(StreamKind stream)
        {
            return Calls.FrameView(Handle, stream);
        }

        /// <summary>Pixels of an image, vertices of a mesh, or three times its triangles.</summary>
        public int Count(StreamKind stream)
        {
            View view = View(stream);
            return checked((int)(view.Width * view.Height));
        }

        public Intrinsics Intrinsics()
        {
            return Calls.FrameIntrinsics(Handle);
        }

        public Camera Camera()
        {
            return Calls.FrameCamera(Handle);
        }

        /// <summary>The source's data under that key, as JSON; null if there is none.</summary>
        public string Meta(string key)
        {
            uint length;
            fixed (byte* name = Utf8Text.Encode(key, "key"))
            {
                byte* few = stackalloc byte[Utf8Text.Few];
                if (Calls.FrameMeta(Handle, name, few, Utf8Text.Few, &length) == Result.NotReady) return null;
                if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
                var many = new byte[length + 1];
                fixed (byte* bytes = many)
                {
                    Calls.FrameMeta(Handle, name, bytes, length + 1, &length);
                    return Utf8Text.Read(bytes, many.Length);
                }
            }
        }

        public Body[] Bodies()
        {
            return Calls.FrameBodies(Handle);
        }

        /// <summary>Into an array of one's own; returns how many. Too short: ErrorCapacity.</summary>
        public int Bodies(Body[] into)
        {
            return Calls.FrameBodies(Handle, into);
        }

        /// <summary>Joints that are seen or inferred.</summary>
        public Joint[] Joints(uint bodyId)
        {
            return Calls.FrameJoints(Handle, bodyId);
        }

        public int Joints(uint bodyId, Joint[] into)
        {
            return Calls.FrameJoints(Handle, bodyId, into);
        }

        /// <summary>The person to scan and to follow; 0: nobody.</summary>
        public uint ActiveBody()
        {
            ActiveState state;
            return ActiveBody(out state);
        }

        public uint ActiveBody(out ActiveState state)
        {
            uint body;
            ActiveState found;
            Calls.FrameActiveBody(Handle, &body, &found);
            state = found;
            return body;
        }
    }

    public unsafe partial struct View
    {
        /// <summary>16-byte aligned, rows RowStride bytes apart.</summary>
        public IntPtr Data
        {
            get { return (IntPtr)data; }
        }
    }
}
