// A scan: frames of one person become measurements, each with its deviation.
namespace Vfit
{
    public sealed unsafe class Scan : VfitObject<ScanHandle>
    {
        public Context Context { get; private set; }

        public Scan(Context context, ScanDesc desc = default(ScanDesc))
            : base(new ScanHandle(Context.Of(context, "context")))
        {
            Context = context;
            desc.StructSize = (uint)sizeof(ScanDesc);
            Calls.ScanCreate(context.Handle, &desc, Handle);
        }

        /// <summary>
        /// Ok: complete. NotReady: taken, more needed. Incomplete: refused, see state.Guidance.
        /// </summary>
        public Result Add(Frame tracked, uint bodyId, out ScanState state)
        {
            var filled = new ScanState();
            filled.StructSize = (uint)sizeof(ScanState);
            Result result = Calls.ScanAdd(Handle, Frame.Of(tracked, "tracked"), bodyId, &filled);
            state = filled;
            return result;
        }

        /// <summary>The same of several cameras: which one saw the frame, from 0 on.</summary>
        public Result AddFrom(uint camera, Frame tracked, uint bodyId, out ScanState state)
        {
            var filled = new ScanState();
            filled.StructSize = (uint)sizeof(ScanState);
            Result result =
                Calls.ScanAddFrom(Handle, camera, Frame.Of(tracked, "tracked"), bodyId, &filled);
            state = filled;
            return result;
        }

        /// <summary>The same for the active person.</summary>
        public Result Add(Frame tracked, out ScanState state)
        {
            Frame.Of(tracked, "tracked");
            return Add(tracked, tracked.ActiveBody(), out state);
        }

        public Result Add(Frame tracked)
        {
            ScanState state;
            return Add(tracked, out state);
        }

        /// <summary>From the first frame on; the values settle with each.</summary>
        public Measurement[] Measure()
        {
            return Calls.ScanMeasure(Handle);
        }

        public int Measure(Measurement[] into)
        {
            return Calls.ScanMeasure(Handle, into);
        }

        /// <summary>The sex that the scan was told, else the likelier one, with its probability.</summary>
        public Sex LikelySex(out float probability)
        {
            Sex sex;
            float likely;
            Calls.ScanSex(Handle, &sex, &likely);
            probability = likely;
            return sex;
        }

        public Collider[] Colliders()
        {
            return Calls.ScanColliders(Handle);
        }

        /// <summary>What a garment of that kind has to be scaled by (Algorithm 3).</summary>
        public Scale Scale(string garmentKind)
        {
            fixed (byte* kind = Utf8Text.Encode(garmentKind, "garmentKind"))
                return Calls.ScanScale(Handle, kind);
        }

        /// <summary>Asks for more frames of this person, also of a complete scan.</summary>
        public void Extend(uint frames, uint sideFrames)
        {
            Calls.ScanExtend(Handle, frames, sideFrames);
        }

        public void Reset()
        {
            Calls.ScanReset(Handle);
        }
    }
}
