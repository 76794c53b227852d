// A recorder: writes frames into a recording folder, which the sensor "recording:PATH" plays.
namespace Vfit
{
    public sealed unsafe class Recorder : VfitObject<RecorderHandle>
    {
        /// <summary>path must not exist or be an empty folder. A rate of 0 means 30 Hz.</summary>
        public Recorder(
            Context context, string path, string sensorName = null, float rateHz = 0, bool segmented = false)
            : base(new RecorderHandle(Context.Of(context, "context")))
        {
            fixed (byte* folder = Utf8Text.Encode(path, "path"), name = Utf8Text.Encode(sensorName))
            {
                var desc = new RecorderDesc();
                desc.StructSize = (uint)sizeof(RecorderDesc);
                desc.sensorName = name;
                desc.RateHz = rateHz;
                desc.Segmented = segmented ? 1u : 0u;
                Calls.RecorderCreate(context.Handle, folder, &desc, Handle);
            }
        }

        public void Write(Frame frame)
        {
            Calls.RecorderWrite(Handle, Frame.Of(frame, "frame"));
        }
    }
}
