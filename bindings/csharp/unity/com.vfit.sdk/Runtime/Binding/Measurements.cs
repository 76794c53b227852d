// Lists of measurements: looked up, kept as text, merged.
using System;

namespace Vfit
{
    public static unsafe class Measurements
    {
        /// <summary>False where that measure is not in the list.</summary>
        public static bool TryFind(Measurement[] list, string key, out Measurement found)
        {
            if (list == null) throw new ArgumentNullException("list");
            foreach (Measurement m in list)
            {
                if (m.Key != key) continue;
                found = m;
                return true;
            }
            found = default(Measurement);
            return false;
        }

        /// <summary>A known measure: its value and its standard deviation (0: unknown).</summary>
        public static Measurement Known(string key, float value, float sigma = 0)
        {
            return new Measurement { Key = key, Value = value, Sigma = sigma, Observed = 1 };
        }

        /// <summary>As JSON, for an app that keeps them with the person's consent.</summary>
        public static string Write(Measurement[] list, Sex sex)
        {
            Arrays.Check(list, 0, "list");
            uint capacity = 0;
            fixed (Measurement* items = list)
            {
                Calls.MeasurementsWrite(
                    items, (uint)sizeof(Measurement), (uint)list.Length, sex, null, &capacity);
                var text = new byte[capacity];
                fixed (byte* bytes = text)
                    Calls.MeasurementsWrite(
                        items, (uint)sizeof(Measurement), (uint)list.Length, sex, bytes, &capacity);
                fixed (byte* bytes = text) return Utf8Text.Read(bytes, text.Length);
            }
        }

        public static Measurement[] Read(string text, out Sex sex)
        {
            byte[] encoded = Utf8Text.Encode(text, "text");
            ulong length = (ulong)encoded.Length - 1;
            Sex found;
            uint count = 0;
            fixed (byte* bytes = encoded)
            {
                Calls.MeasurementsRead(bytes, length, null, (uint)sizeof(Measurement), &count, &found);
                var list = new Measurement[count];
                fixed (Measurement* items = list)
                    if (count > 0)
                        Calls.MeasurementsRead(
                            bytes, length, items, (uint)sizeof(Measurement), &count, &found);
                sex = found;
                return list;
            }
        }

        /// <summary>Two scans of one person in one list.</summary>
        public static Measurement[] Merge(Measurement[] a, Measurement[] b)
        {
            Arrays.Check(a, 0, "a");
            Arrays.Check(b, 0, "b");
            fixed (Measurement* first = a, second = b)
                return Calls.MeasurementsMerge(first, (uint)sizeof(Measurement), (uint)a.Length, second,
                                               (uint)sizeof(Measurement), (uint)b.Length);
        }
    }
}
