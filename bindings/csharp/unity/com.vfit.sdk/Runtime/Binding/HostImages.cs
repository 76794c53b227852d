// Frames from pixels of the host: any depth camera that C# can read.
using System;
using System.Runtime.InteropServices;

namespace Vfit
{
    /// <summary>Images of one moment, packed, all of one size. Users and color may be missing.</summary>
    public struct HostImages
    {
        public int Width, Height;
        /// <summary>
        /// 16 bits per pixel, in units of Camera.DepthUnitM (0: millimetres); 0: no reading.
        /// </summary>
        public IntPtr Depth;
        /// <summary>Of 8 bits a pixel: 0 background, else the body's id.</summary>
        public IntPtr Users;
        /// <summary>Red, green, blue, alpha, registered to depth.</summary>
        public IntPtr Color;
        /// <summary>Of the depth image; width and height are taken from above where they are 0.</summary>
        public Intrinsics Intrinsics;
        /// <summary>Unit of depth and where the floor is; null: millimetres, floor unknown.</summary>
        public Camera? Camera;
        /// <summary>0: now.</summary>
        public long TimeNs;
    }

    public sealed unsafe partial class Frame
    {
        /// <summary>A copy of those pixels. No garbage where into is used again.</summary>
        public static void Create(Context context, ref HostImages images, Frame into)
        {
            Create(context, ref images, into, null);
        }

        /// <summary>
        /// The same without a copy: the pixels must not change until released is called, once, on any thread,
        /// when the last reference is gone. It is not called if this call fails.
        /// </summary>
        public static void Lend(Context context, ref HostImages images, Action released, Frame into)
        {
            if (released == null) throw new ArgumentNullException("released");
            Create(context, ref images, into, released);
        }

        /// <summary>From arrays: users (may be null) has one byte a pixel.</summary>
        public static Frame FromDepth(
            Context context, ushort[] depth, byte[] users, int width, int height, Intrinsics intrinsics,
            long timeNs)
        {
            if (depth == null) throw new ArgumentNullException("depth");
            if (width <= 0 || height <= 0 || depth.LongLength != (long)width * height)
                throw new ArgumentException("depth has not width * height pixels", "depth");
            if (users != null && users.Length != depth.Length)
                throw new ArgumentException("users has not as many pixels as depth", "users");
            fixed (ushort* depthPixels = depth)
            fixed (byte* userPixels = users)
            {
                var images = new HostImages
                {
                    Width = width, Height = height, Depth = (IntPtr)depthPixels, Users = (IntPtr)userPixels,
                    Intrinsics = intrinsics, TimeNs = timeNs
                };
                var frame = new Frame(context);
                try
                {
                    Create(context, ref images, frame);
                }
                catch
                {
                    frame.Dispose();
                    throw;
                }
                return frame;
            }
        }

        private static void Create(Context context, ref HostImages images, Frame into, Action released)
        {
            if (images.Width <= 0 || images.Height <= 0)
                throw new ArgumentException("images without a size", "images");
            FrameHandle target = Of(into, "into");
            const int most = 3;
            StreamKind* streams = stackalloc StreamKind[most];
            View* views = stackalloc View[most];
            uint count = 0;
            Add(streams, views, ref count, ref images, StreamKind.Depth, Format.U16, images.Depth);
            Add(streams, views, ref count, ref images, StreamKind.UserMap, Format.U8, images.Users);
            Add(streams, views, ref count, ref images, StreamKind.Color, Format.Rgba8, images.Color);
            Intrinsics intrinsics = images.Intrinsics;
            intrinsics.StructSize = (uint)sizeof(Intrinsics);
            if (intrinsics.Width == 0) intrinsics.Width = (uint)images.Width;
            if (intrinsics.Height == 0) intrinsics.Height = (uint)images.Height;
            Camera camera = images.Camera.GetValueOrDefault();
            camera.StructSize = (uint)sizeof(Camera);

            var desc = new FrameDesc();
            desc.StructSize = (uint)sizeof(FrameDesc);
            desc.Count = count;
            desc.streams = streams;
            desc.views = views;
            desc.intrinsics = &intrinsics;
            desc.camera = images.Camera.HasValue ? &camera : null;
            desc.TimeNs = images.TimeNs;
            if (released == null)
            {
                Calls.FrameCreate(Context.Of(context, "context"), &desc, target);
                return;
            }
            GCHandle kept = GCHandle.Alloc(released);
            desc.release = LentPixels.Function;
            desc.user = (void*)GCHandle.ToIntPtr(kept);
            try
            {
                Calls.FrameCreate(Context.Of(context, "context"), &desc, target);
            }
            catch (VfitException)
            {
                kept.Free();
                throw;
            }
        }

        private static void Add(
            StreamKind* streams, View* views, ref uint count, ref HostImages images, StreamKind stream,
            Format format, IntPtr data)
        {
            if (data == IntPtr.Zero) return;
            streams[count] = stream;
            views[count] = new View
            {
                StructSize = (uint)sizeof(View), Format = format, data = (void*)data,
                Width = (uint)images.Width, Height = (uint)images.Height
            };
            count++;
        }
    }

    internal static class LentPixels
    {
        private static readonly ReleaseFn kept = OnRelease;

        internal static readonly IntPtr Function = Marshal.GetFunctionPointerForDelegate(kept);

        [MonoPInvokeCallback(typeof(ReleaseFn))]
        private static void OnRelease(IntPtr user)
        {
            try
            {
                GCHandle handle = GCHandle.FromIntPtr(user);
                var released = (Action)handle.Target;
                handle.Free();
                released();
            }
            catch
            {
                // Native code is above: nothing may be thrown into it.
            }
        }
    }
}
