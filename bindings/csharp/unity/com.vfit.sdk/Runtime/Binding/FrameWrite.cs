// Streams of a frame into memory of the caller's: an array, a mapped vertex buffer. Nothing is allocated.
using System;

namespace Vfit
{
    public sealed unsafe partial class Frame
    {
        /// <summary>
        /// Writes item i to data + i * stride (0: packed), at most capacity bytes. Returns NotReady without a
        /// copy if serial is the frame's: meshes that did not change cost nothing.
        /// </summary>
        public Result Write(
            StreamKind stream, IntPtr data, long capacity, Format format, int stride, ref ulong serial)
        {
            fixed (ulong* known = &serial) return Write(stream, (void*)data, capacity, format, stride, known);
        }

        public Result Write(StreamKind stream, IntPtr data, long capacity, Format format, int stride)
        {
            return Write(stream, (void*)data, capacity, format, stride, null);
        }

        /// <summary>Vertex data as floats, or depth in metres.</summary>
        public Result Write(StreamKind stream, float[] into)
        {
            fixed (float* data = into)
                return Write(stream, data, Bytes(into, sizeof(float)), FloatFormat(stream), 0, null);
        }

        public Result Write(StreamKind stream, float[] into, ref ulong serial)
        {
            fixed (float* data = into)
            fixed (ulong* known = &serial)
                return Write(stream, data, Bytes(into, sizeof(float)), FloatFormat(stream), 0, known);
        }

        /// <summary>Positions or normals.</summary>
        public Result Write(StreamKind stream, Float3[] into)
        {
            fixed (Float3* data = into)
                return Write(stream, data, Bytes(into, sizeof(Float3)), Format.F32x3, 0, null);
        }

        public Result Write(StreamKind stream, Float3[] into, ref ulong serial)
        {
            fixed (Float3* data = into)
            fixed (ulong* known = &serial)
                return Write(stream, data, Bytes(into, sizeof(Float3)), Format.F32x3, 0, known);
        }

        /// <summary>Indices of a mesh, three a triangle.</summary>
        public Result Write(StreamKind stream, int[] into)
        {
            fixed (int* data = into)
                return Write(stream, data, Bytes(into, sizeof(int)), Format.U32, 0, null);
        }

        /// <summary>Depth in the camera's unit, bones of a skin (8 per vertex), or 16-bit indices.</summary>
        public Result Write(StreamKind stream, ushort[] into)
        {
            Format format = stream == StreamKind.SkinBones ? Format.U16x8 : Format.U16;
            fixed (ushort* data = into)
                return Write(stream, data, Bytes(into, sizeof(ushort)), format, 0, null);
        }

        /// <summary>Colour, four bytes a pixel, or the user map.</summary>
        public Result Write(StreamKind stream, byte[] into)
        {
            Format format = stream == StreamKind.Color ? Format.Rgba8 : Format.U8;
            fixed (byte* data = into) return Write(stream, data, Bytes(into, 1), format, 0, null);
        }

        private Result Write(
            StreamKind stream, void* data, long capacity, Format format, int stride, ulong* serial)
        {
            Target target = Vfit.Target.At(data, capacity, format, stride);
            return Calls.FrameWrite(Handle, stream, &target, serial);
        }

        private static long Bytes(Array array, int item)
        {
            if (array == null) throw new ArgumentNullException("into");
            return array.LongLength * item;
        }

        private static Format FloatFormat(StreamKind stream)
        {
            switch (stream)
            {
                case StreamKind.Position:
                case StreamKind.Normal: return Format.F32x3;
                case StreamKind.Uv: return Format.F32x2;
                case StreamKind.BoneMatrix: return Format.F32x16;
                case StreamKind.SkinWeights: return Format.F32x8;
                default: return Format.F32;
            }
        }
    }

    public unsafe partial struct Target
    {
        internal static Target At(void* data, long capacity, Format format, int stride)
        {
            if (capacity < 0) throw new ArgumentOutOfRangeException("capacity");
            if (stride < 0) throw new ArgumentOutOfRangeException("stride");
            var target = new Target();
            target.StructSize = (uint)sizeof(Target);
            target.Format = format;
            target.data = data;
            target.Capacity = (ulong)capacity;
            target.ItemStride = (uint)stride;
            return target;
        }
    }
}
