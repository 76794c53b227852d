// Prop: a solid beside a body that cloth stays outside of, such as a chair, a weapon, a bag or hair.
using System;

namespace Vfit
{
    public sealed unsafe class Prop : VfitObject<PropHandle>
    {
        private Prop(Context context, PropDesc desc) : base(new PropHandle(Context.Of(context, "context")))
        {
            desc.StructSize = (uint)sizeof(PropDesc);
            Calls.PropCreate(context.Handle, &desc, Handle);
        }

        public static Prop Sphere(Context context, float radius)
        {
            return Shape(context, PropShape.Sphere, radius, 0, 0);
        }

        /// <summary>
        /// Along the up axis. halfLength: from the middle to each of the two centres.
        /// </summary>
        public static Prop Capsule(Context context, float radius, float halfLength)
        {
            return Shape(context, PropShape.Capsule, radius, halfLength, 0);
        }

        /// <summary>half: of each edge.</summary>
        public static Prop Box(Context context, Float3 half)
        {
            return Shape(context, PropShape.Box, half.X, half.Y, half.Z);
        }

        /// <summary>Triangles are wound as those that the context writes.</summary>
        public static Prop Mesh(Context context, Float3[] positions, uint[] indices)
        {
            Arrays.Check(positions, 0, "positions");
            Arrays.Check(indices, 0, "indices");
            fixed (Float3* places = positions)
            fixed (uint* corners = indices)
            {
                var desc = new PropDesc();
                desc.Shape = PropShape.Mesh;
                desc.positions = (float*)places;
                desc.VertexCount = (uint)positions.Length;
                desc.indices = corners;
                desc.IndexCount = (uint)indices.Length;
                return new Prop(context, desc);
            }
        }

        private static Prop Shape(Context context, PropShape shape, float x, float y, float z)
        {
            var desc = new PropDesc();
            desc.Shape = shape;
            desc.Size = new Float3(x, y, z);
            return new Prop(context, desc);
        }

        /// <summary>Where it is at the end of the next step of each cloth that meets it.</summary>
        public void Move(Float3 position, Float4 rotation)
        {
            Calls.PropMove(Handle, &position.X, &rotation.X);
        }

        /// <summary>The vertices of a mesh, in the prop's own frame.</summary>
        public void Deform(Float3[] positions)
        {
            Arrays.Check(positions, 0, "positions");
            fixed (Float3* places = positions)
                Calls.PropDeform(Handle, (float*)places, (uint)positions.Length);
        }
    }
}
