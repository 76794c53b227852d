// Float arrays of fixed length as they lie in the library's structs.
using System;
using System.Runtime.InteropServices;

namespace Vfit
{
    /// <summary>A place, direction or velocity, in the axes of the context.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Float3
    {
        public float X, Y, Z;

        public Float3(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public override string ToString()
        {
            return "(" + X + ", " + Y + ", " + Z + ")";
        }
    }

    /// <summary>A quaternion: x, y, z, w.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Float4
    {
        public float X, Y, Z, W;

        public Float4(float x, float y, float z, float w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }

        public override string ToString()
        {
            return "(" + X + ", " + Y + ", " + Z + ", " + W + ")";
        }
    }

    /// <summary>A 4 x 4 matrix, stored column by column.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Float16
    {
        private fixed float values[16];

        public float this[int row, int column]
        {
            get
            {
                CheckIndex(row, column);
                fixed (float* first = values) return first[column * 4 + row];
            }
            set
            {
                CheckIndex(row, column);
                fixed (float* first = values) first[column * 4 + row] = value;
            }
        }

        private static void CheckIndex(int row, int column)
        {
            if ((uint)row > 3 || (uint)column > 3) throw new IndexOutOfRangeException();
        }
    }
}
