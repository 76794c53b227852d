// A sensor: a camera, a recording or the virtual person, by its URI.
using System;
using System.Collections.Generic;

namespace Vfit
{
    public sealed unsafe class Sensor : VfitObject<SensorHandle>
    {
        public Context Context { get; private set; }

        /// <summary>"recording:PATH", "virtual:motion=demo", ...</summary>
        public Sensor(Context context, string uri) : base(new SensorHandle(Context.Of(context, "context")))
        {
            Context = context;
            fixed (byte* text = Utf8Text.Encode(uri, "uri")) Calls.SensorOpen(context.Handle, text, Handle);
        }

        public SensorMode[] Modes()
        {
            return Calls.SensorModes(Handle);
        }

        public SensorOption[] Options()
        {
            return Calls.SensorOptions(Handle);
        }

        /// <summary>
        /// Before the start. "pace" is "realtime" (drops frames as a camera does) or "none".
        /// </summary>
        public void SetOption(string key, string value)
        {
            fixed (byte* k = Utf8Text.Encode(key, "key"), v = Utf8Text.Encode(value, "value"))
                Calls.SensorSetOption(Handle, k, v);
        }

        public void Start()
        {
            Calls.SensorStart(Handle);
        }

        public void Stop()
        {
            Calls.SensorStop(Handle);
        }

        public SensorStats Stats()
        {
            return Calls.SensorDescribe(Handle);
        }

        /// <summary>
        /// Fills the frame with the newest one; it is empty unless the result is Ok. 0 seconds never wait,
        /// below 0 waits without end. Timeout and EndOfStream are returned, errors of the stream are thrown.
        /// </summary>
        public Result Acquire(Frame into, double timeoutS)
        {
            return Calls.SensorAcquire(Handle, Nanoseconds(timeoutS), Frame.Of(into, "into"));
        }

        /// <summary>
        /// Starts the sensor if it does not run, and gives frames until the stream ends. It is the same Frame
        /// every time: copy the data to keep.
        /// </summary>
        public IEnumerable<Frame> Frames()
        {
            if (Stats().Running == 0) Start();
            using (var frame = new Frame(Context))
                while (Acquire(frame, -1) == Result.Ok)
                    yield return frame;
        }

        private static long Nanoseconds(double seconds)
        {
            if (double.IsNaN(seconds)) throw new ArgumentException("the time-out is no number", "timeoutS");
            if (seconds < 0) return -1;
            double nanoseconds = seconds * 1e9;
            return nanoseconds < 9e18 ? (long)nanoseconds : -1;     // three hundred years are without end
        }
    }
}
