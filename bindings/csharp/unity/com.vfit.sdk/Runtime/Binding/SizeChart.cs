// A size chart: measurements become labels with their probability.
using System;

namespace Vfit
{
    public sealed unsafe class SizeChart : VfitObject<SizeChartHandle>
    {
        private SizeChart(Context context) : base(new SizeChartHandle(Context.Of(context, "context"))) { }

        /// <summary>Names of the charts in the data folder.</summary>
        public static DataName[] List(Context context)
        {
            return Calls.SizeChartList(context.Handle);
        }

        /// <summary>A chart of the data folder, by name.</summary>
        public static SizeChart Open(Context context, string name)
        {
            byte[] text = Utf8Text.Encode(name, "name");
            var chart = new SizeChart(context);
            fixed (byte* bytes = text) Calls.SizeChartOpen(context.Handle, bytes, chart.Handle);
            return chart;
        }

        /// <summary>A chart as JSON (docs/size-charts.md).</summary>
        public static SizeChart Load(Context context, string json)
        {
            byte[] text = Utf8Text.Encode(json, "json");
            var chart = new SizeChart(context);
            fixed (byte* bytes = text)
                Calls.SizeChartLoad(context.Handle, bytes, (ulong)text.Length - 1, chart.Handle);
            return chart;
        }

        public SizeRow[] Rows()
        {
            return Calls.SizeChartRows(Handle);
        }

        /// <summary>Every label of that kind of garment, the best first; probabilities sum to 1.</summary>
        public Size[] Recommend(string garmentKind, Measurement[] measures)
        {
            Arrays.Check(measures, 0, "measures");
            fixed (byte* kind = Utf8Text.Encode(garmentKind, "garmentKind"))
            fixed (Measurement* items = measures)
                return Calls.SizeRecommend(
                    Handle, kind, items, (uint)sizeof(Measurement), (uint)measures.Length);
        }

        /// <summary>How that size sits, measure by measure.</summary>
        public SizeZone[] Zones(string garmentKind, string label, Measurement[] measures)
        {
            Arrays.Check(measures, 0, "measures");
            fixed (byte* kind = Utf8Text.Encode(garmentKind, "garmentKind"),
                   size = Utf8Text.Encode(label, "label"))
            fixed (Measurement* items = measures)
                return Calls.SizeZones(
                    Handle, kind, size, items, (uint)sizeof(Measurement), (uint)measures.Length);
        }
    }
}
