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

        /// <summary>
        /// A calibration to a tape of your own, as JSON, with one more person: what the scan and what the
        /// tape told. Null: the first one.
        /// </summary>
        public static string AddToCalibration(string calibration, Measurement[] scanned, Measurement[] taped)
        {
            Arrays.Check(scanned, 0, "scanned");
            Arrays.Check(taped, 0, "taped");
            byte[] encoded = calibration == null ? null : Utf8Text.Encode(calibration, "calibration");
            ulong length = encoded == null ? 0 : (ulong)encoded.Length - 1;
            uint stride = (uint)sizeof(Measurement), capacity = 0;
            fixed (byte* before = encoded)
            fixed (Measurement* scan = scanned, tape = taped)
            {
                Calls.CalibrationAdd(before, length, scan, stride, (uint)scanned.Length, tape, stride,
                                     (uint)taped.Length, null, &capacity);
                var text = new byte[capacity];
                fixed (byte* bytes = text)
                {
                    Calls.CalibrationAdd(before, length, scan, stride, (uint)scanned.Length, tape, stride,
                                         (uint)taped.Length, bytes, &capacity);
                    return Utf8Text.Read(bytes, text.Length);
                }
            }
        }

        /// <summary>What a calibration says of each measure.</summary>
        public static CalibratedMeasure[] Calibrated(string calibration)
        {
            byte[] encoded = Utf8Text.Encode(calibration, "calibration");
            fixed (byte* bytes = encoded)
                return Calls.CalibrationMeasures(bytes, (ulong)encoded.Length - 1);
        }

        /// <summary>Measures of a scan as the calibration's tape would tell them.</summary>
        public static Measurement[] Calibrate(string calibration, Measurement[] scanned)
        {
            Arrays.Check(scanned, 0, "scanned");
            byte[] encoded = Utf8Text.Encode(calibration, "calibration");
            fixed (byte* bytes = encoded)
            fixed (Measurement* scan = scanned)
                return Calls.CalibrationApply(bytes, (ulong)encoded.Length - 1, scan,
                                              (uint)sizeof(Measurement), (uint)scanned.Length);
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
