// Frames of an avatar or a cloth into a Unity mesh: written into arrays that stay, then uploaded.
using System;
using UnityEngine;
using UnityEngine.Rendering;

namespace Vfit.Unity
{
    public sealed unsafe class MeshWriter
    {
        private Vector3[] positions = new Vector3[0], normals = new Vector3[0];
        private int[] triangles;
        private ulong serial;

        public Mesh Mesh { get; private set; }

        public MeshWriter(Mesh mesh)
        {
            Mesh = mesh;
            mesh.MarkDynamic();
        }

        /// <summary>
        /// The streams of the frame; uv and triangles only if the number of vertices changed.
        /// </summary>
        public void Write(Frame frame)
        {
            int count = frame.Count(StreamKind.Position);
            if (count != positions.Length) Rebuild(frame, count);
            else if (!Fetch(frame)) return;
            Mesh.SetVertices(positions);
            Mesh.SetNormals(normals);
            if (triangles != null)
            {
                // After the vertices, as Unity checks indices against them.
                Mesh.SetTriangles(triangles, 0);
                triangles = null;
            }
            Mesh.RecalculateBounds();
        }

        /// <summary>Leaves out the triangles whose byte is 1.</summary>
        public void Hide(byte[] hidden)
        {
            int[] all = Mesh.triangles;
            if (all.Length != 3 * hidden.Length) throw new ArgumentException("one byte a triangle", "hidden");
            int kept = 0;
            for (int i = 0; i < hidden.Length; i++)
            {
                if (hidden[i] == 1) continue;
                for (int corner = 0; corner < 3; corner++) all[kept++] = all[3 * i + corner];
            }
            Array.Resize(ref all, kept);
            Mesh.SetTriangles(all, 0);
        }

        private void Rebuild(Frame frame, int count)
        {
            positions = new Vector3[count];
            normals = new Vector3[count];
            serial = 0;
            var uv = new Vector2[count];
            fixed (Vector2* first = uv)
                frame.Write(StreamKind.Uv, (IntPtr)first, (long)count * sizeof(Vector2), Format.F32x2, 0);
            triangles = new int[frame.Count(StreamKind.Index)];
            frame.Write(StreamKind.Index, triangles);
            Fetch(frame);
            Mesh.Clear();
            // At detail 1, the body has more vertices than 16-bit indices can address.
            Mesh.indexFormat = IndexFormat.UInt32;
            Mesh.SetVertices(positions);
            Mesh.SetUVs(0, uv);
        }

        /// <summary>False where the mesh is that of the last call already.</summary>
        private bool Fetch(Frame frame)
        {
            long capacity = (long)positions.Length * sizeof(Vector3);
            Result result;
            fixed (Vector3* first = positions)
                result = frame.Write(
                    StreamKind.Position, (IntPtr)first, capacity, Format.F32x3, 0, ref serial);
            if (result == Result.NotReady) return false;
            fixed (Vector3* first = normals)
                frame.Write(StreamKind.Normal, (IntPtr)first, capacity, Format.F32x3, 0);
            return true;
        }
    }
}
