// A garment: a pattern that cloth is made from.
using System.Collections.Generic;

namespace Vfit
{
    public sealed unsafe class Garment : VfitObject<GarmentHandle>
    {
        private Garment(Context context) : base(new GarmentHandle(Context.Of(context, "context"))) { }

        /// <summary>Names of the garments in the data folder.</summary>
        public static DataName[] List(Context context)
        {
            return Calls.GarmentList(context.Handle);
        }

        /// <summary>A garment of the data folder, by name.</summary>
        public static Garment Open(Context context, string name)
        {
            byte[] text = Utf8Text.Encode(name, "name");
            var garment = new Garment(context);
            fixed (byte* bytes = text) Calls.GarmentOpen(context.Handle, bytes, garment.Handle);
            return garment;
        }

        /// <summary>A garment as JSON (docs/garments.md).</summary>
        public static Garment Load(Context context, string json)
        {
            byte[] text = Utf8Text.Encode(json, "json");
            var garment = new Garment(context);
            fixed (byte* bytes = text)
                Calls.GarmentLoad(context.Handle, bytes, (ulong)text.Length - 1, garment.Handle);
            return garment;
        }

        public GarmentInfo Describe()
        {
            return Calls.GarmentDescribe(Handle);
        }

        /// <summary>Triangles by their look.</summary>
        public GarmentPart[] Parts()
        {
            return Calls.GarmentParts(Handle);
        }

        public List<string> SizeLabels()
        {
            var labels = new List<string>();
            for (uint i = 0; ; i++)
            {
                string label = Calls.GarmentSizeLabel(Handle, i);
                if (label.Length == 0) return labels;
                labels.Add(label);
            }
        }
    }
}
