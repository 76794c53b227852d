// Written by scripts/csharp-bindings from include/vfit.h: change that, then run the script.
using System;
using System.Runtime.InteropServices;

namespace Vfit
{
    public enum Result : int
    {
        Ok = 0,
        NotReady = 1,
        Timeout = 2,
        Incomplete = 3,
        EndOfStream = 4,
        ErrorUnknown = -1,
        ErrorArgument = -2,
        /// <summary>null, destroyed, or of another kind</summary>
        ErrorHandle = -3,
        /// <summary>right call, wrong moment</summary>
        ErrorState = -4,
        ErrorBusy = -5,
        /// <summary>array or target too small; *count holds the need</summary>
        ErrorCapacity = -6,
        ErrorUnsupported = -7,
        ErrorVersion = -8,
        ErrorOutOfMemory = -9,
        ErrorIo = -10,
        /// <summary>file, frame or garment content is malformed</summary>
        ErrorData = -11,
        ErrorDeviceLost = -12,
        ErrorPlugin = -13,
        /// <summary>the garment in that size does not close around the body</summary>
        ErrorNotWearable = -14,
    }

    public enum Axes : int
    {
        RhYUp = 0,
        Unity = 1,
        Unreal = 2,
    }

    public enum LogLevel : int
    {
        Error = 0,
        Warning = 1,
        Info = 2,
        Debug = 3,
    }

    /// <summary>DETERMINISTIC: equal bits for equal input, binary and SIMD level, any worker count.
    /// Always so as yet.</summary>
    [Flags]
    public enum ContextFlags : uint
    {
        None = 0,
        /// <summary>reserved for slower checks; this version's are always on</summary>
        Validate = 1,
        Deterministic = 2,
        Mirror = 4,
    }

    /// <summary>One meaning everywhere: SHOULDER is the head of the humerus, HIP that of the femur, HAND
    /// the hand's centre of mass in the palm (some 7 cm from the wrist), FOOT the ankle joint; LEFT is
    /// the person's own left.</summary>
    public enum JointId : int
    {
        Head = 0,
        Neck = 1,
        Torso = 2,
        LeftShoulder = 3,
        RightShoulder = 4,
        LeftElbow = 5,
        RightElbow = 6,
        LeftHand = 7,
        RightHand = 8,
        LeftHip = 9,
        RightHip = 10,
        LeftKnee = 11,
        RightKnee = 12,
        LeftFoot = 13,
        /// <summary>the paper's 15</summary>
        RightFoot = 14,
        Pelvis = 15,
        Chest = 16,
        LeftClavicle = 17,
        RightClavicle = 18,
        LeftWrist = 19,
        RightWrist = 20,
        LeftToes = 21,
        RightToes = 22,
    }

    /// <summary>VRM humanoid bones; parents stand before children.</summary>
    public enum BoneId : int
    {
        Hips = 0,
        Spine = 1,
        Chest = 2,
        UpperChest = 3,
        Neck = 4,
        Head = 5,
        LeftShoulder = 6,
        LeftUpperArm = 7,
        LeftLowerArm = 8,
        LeftHand = 9,
        RightShoulder = 10,
        RightUpperArm = 11,
        RightLowerArm = 12,
        RightHand = 13,
        LeftUpperLeg = 14,
        LeftLowerLeg = 15,
        LeftFoot = 16,
        LeftToes = 17,
        RightUpperLeg = 18,
        RightLowerLeg = 19,
        RightFoot = 20,
        RightToes = 21,
    }

    public enum StreamKind : int
    {
        /// <summary>U16 in units of vfit_camera.depth_unit_m, 0: no reading</summary>
        Depth = 0,
        /// <summary>RGBA8, registered to depth</summary>
        Color = 1,
        /// <summary>U8: 0 background, else the body's id</summary>
        UserMap = 2,
        Position = 16,
        Normal = 17,
        /// <summary>one a vertex</summary>
        Uv = 18,
        /// <summary>U32, three a triangle</summary>
        Index = 19,
        /// <summary>skinning matrices, one a rig bone</summary>
        BoneMatrix = 20,
        /// <summary>U16X8: rig bones that carry a vertex</summary>
        SkinBones = 21,
        /// <summary>F32X8: their weights, sum 1, zero where unused</summary>
        SkinWeights = 22,
        /// <summary>F32, mean edge strain at a vertex, 0 = unstretched</summary>
        Strain = 23,
        /// <summary>F32, Pa: what the body presses with against a vertex</summary>
        Pressure = 24,
    }

    public enum Format : int
    {
        None = 0,
        U8 = 1,
        U16 = 2,
        U32 = 3,
        F32 = 4,
        Rgba8 = 5,
        F32x2 = 6,
        F32x3 = 7,
        F32x16 = 8,
        U16x8 = 9,
        F32x8 = 10,
    }

    public enum FloorState : int
    {
        /// <summary>nobody knows: level camera, 1 m above the floor</summary>
        Default = 0,
        /// <summary>seen in the depth image; else below the first body's feet</summary>
        Estimated = 1,
        /// <summary>by the sensor, the recording or the host</summary>
        Given = 2,
    }

    public enum JointState : int
    {
        NotSeen = 0,
        Inferred = 1,
        Measured = 2,
    }

    [Flags]
    public enum BodyFlags : uint
    {
        None = 0,
        /// <summary>input only: positions are in camera space</summary>
        CameraSpace = 1,
        PartlyOutOfView = 2,
    }

    public enum TrackSource : int
    {
        /// <summary>the source's where it tells them, else the built-in tracker's</summary>
        Auto = 0,
        BuiltIn = 1,
        /// <summary>the source's alone: UNSUPPORTED where it tells none</summary>
        Given = 2,
    }

    /// <summary>Joints steadied over time by a one-Euro filter, their states lowered to what their
    /// confidence bears out: MEASURED from 0.5 on, INFERRED from 0.15 on; where a body has states and no
    /// confidence those stand for it.</summary>
    public enum JointFilter : int
    {
        /// <summary>the tracker's own joints and submitted ones; a source's own stay as they are (a
        /// recording's, the truth of a virtual person)</summary>
        Auto = 0,
        /// <summary>a source's own too</summary>
        On = 1,
        /// <summary>none</summary>
        Off = 2,
    }

    /// <summary>The active person, whom a mirror serves. Somebody else becomes it who has been better by
    /// 0.3 m for one second without a break; who is out of sight is waited for two seconds.</summary>
    public enum Follow : int
    {
        /// <summary>to the camera</summary>
        Nearest = 0,
        /// <summary>least to the side of the camera's axis</summary>
        Centred = 1,
        /// <summary>who came first, as long as they stay</summary>
        First = 2,
        /// <summary>nobody but whom vfit_tracker_set_active names</summary>
        Chosen = 3,
    }

    public enum ActiveState : int
    {
        Nobody = 0,
        ByRule = 1,
        Chosen = 2,
        /// <summary>out of sight, waited for: the frame has no such body</summary>
        Lost = 3,
    }

    /// <summary>The body model fitted to a person's depth and outline, where the tracker finds the joints
    /// by itself: they move to the fitted body's and get rotations, as long as it meets the picture. The
    /// first frame with a person may take half a second longer.</summary>
    public enum TrackFit : int
    {
        /// <summary>of the active person</summary>
        Auto = 0,
        /// <summary>of nobody</summary>
        Off = 1,
        /// <summary>some 2.5 ms a person</summary>
        Everybody = 2,
    }

    public enum Sex : int
    {
        Unknown = 0,
        Female = 1,
        Male = 2,
    }

    public enum ScanMethod : int
    {
        /// <summary>FIT</summary>
        Default = 0,
        /// <summary>the paper's, with anthropometric ratios, weighted means, outliers left out</summary>
        Proportions = 1,
        /// <summary>the artists' canon and plain means of the paper's text</summary>
        ProportionsAsPrinted = 2,
        /// <summary>a body fitted to all frames, measures learnt from it</summary>
        Fit = 3,
    }

    public enum Guidance : int
    {
        None = 0,
        StepBack = 1,
        StepCloser = 2,
        ArmsOut = 3,
        HoldStill = 4,
        TurnSideways = 5,
        FeetNotVisible = 6,
        OnePersonOnly = 7,
        Nobody = 8,
        JointsMissing = 9,
        FaceCamera = 10,
        /// <summary>go on turning: that way has been seen</summary>
        TurnRound = 11,
        TurnSlower = 12,
        /// <summary>from the side an arm hides the trunk</summary>
        ArmsForward = 13,
    }

    [Flags]
    public enum ScanFlags : uint
    {
        None = 0,
        /// <summary>bits of flags. Bare feet and no hair on the crown: otherwise the deviation of FIT's
        /// stature allows for both</summary>
        Bare = 1,
        /// <summary>of FIT: the clothes lie on the skin, as sportswear does. Otherwise up to 3 cm of cloth
        /// are reckoned with</summary>
        Tight = 2,
        /// <summary>of FIT: after the other frames the person turns once round on the spot, arms held out:
        /// girths of the trunk from its surface all around are combined with those of the other
        /// views</summary>
        Turn = 4,
    }

    public enum DoubtKind : int
    {
        /// <summary>by the others, and no slip below explains it</summary>
        Unlikely = 0,
        /// <summary>inches were taken for centimetres</summary>
        Inches = 1,
        /// <summary>pounds were taken for kilograms</summary>
        Pounds = 2,
        /// <summary>one digit is wrong, or two are in the wrong order</summary>
        Digit = 3,
        /// <summary>its value and that of other_key stand in each other's place</summary>
        Swapped = 4,
    }

    [Flags]
    public enum ContactFlags : uint
    {
        None = 0,
        Left = 1,
        Right = 2,
    }

    [Flags]
    public enum MotionFlags : uint
    {
        None = 0,
        /// <summary>positions as they come</summary>
        NoFilter = 1,
        /// <summary>no joint limits</summary>
        NoLimits = 2,
        /// <summary>no rotation smoothing (Eq. 8-10)</summary>
        NoSmoothing = 4,
        /// <summary>no foot-skate correction (Alg. 5 and 6)</summary>
        NoFeet = 8,
    }

    /// <summary>Of joint positions. ADAPTIVE learns how noisy each joint is: it averages over seconds at
    /// rest and follows within a frame in motion. HOLT is the paper's, by the five names of the Kinect
    /// SDK. All are converted by elapsed time.</summary>
    public enum PositionFilter : int
    {
        Adaptive = 0,
        Holt = 1,
        OneEuro = 2,
    }

    /// <summary>How feet that stand are found: by a network that has learnt it, or by the paper's
    /// thresholds of height and speed (Alg. 5), with hysteresis.</summary>
    public enum ContactRule : int
    {
        Learnt = 0,
        Thresholds = 1,
    }

    /// <summary>A pose as one packet of Open Sound Control 1.0, at most 2,048 bytes, for the host to send
    /// by UDP; vfit opens no socket. docs/motion.md has ports and receivers.</summary>
    public enum Osc : int
    {
        /// <summary>VMC protocol: /VMC/Ext/OK, T (pose.time_ns in seconds), Root/Pos (the origin), and
        /// Bone/Pos of all bones by the names of Unity's HumanBodyBones</summary>
        Vmc = 0,
        /// <summary>VRChat's OSC trackers: 1 hips, 2 chest, 3 and 4 feet, 5 and 6 knees, 7 and 8 elbows, left
        /// before right, and the head</summary>
        Vrchat = 1,
    }

    [Flags]
    public enum AvatarFlags : uint
    {
        None = 0,
        /// <summary>radii of Algorithm 2 as they are, not clamped to the skin</summary>
        PaperColliders = 1,
        /// <summary>no twist bones in the limbs (Fig. 7a)</summary>
        SingleBones = 2,
        /// <summary>skinned by dual quaternions in place of linear blending: joints that bend or twist far
        /// keep their section. An engine that skins by BONE_MATRIX shows the linear blend</summary>
        DualQuaternions = 4,
        /// <summary>arms stay where the pose puts them; without, they are moved out of trunk, thighs and each
        /// other, with 2 cm of room for cloth, and where two parts of a body's skin press into each other,
        /// both give way: there POSITION differs from what BONE_MATRIX gives</summary>
        LimbsAsPosed = 8,
    }

    public enum CharacterKind : int
    {
        /// <summary>vfit's own body</summary>
        Body = 0,
        Gltf = 1,
        Vrm0 = 2,
        Vrm1 = 3,
    }

    [Flags]
    public enum ClothFlags : uint
    {
        None = 0,
        /// <summary>hands and forearms pass through all but their own sleeve. Without it, they meet all but
        /// the other arm's sleeve; on the skin, an arm that stretches cloth beyond 1.6 times its length
        /// passes until it is free of it. On spheres and capsules, garments with sleeves always keep
        /// both</summary>
        NoHands = 1,
        /// <summary>kept out of the avatar's skin itself, not of its spheres and capsules: closer, and
        /// slower</summary>
        Skin = 2,
        /// <summary>stepped even where cloth and body have lain still for half a second</summary>
        Awake = 4,
        /// <summary>frames carry PRESSURE</summary>
        Pressure = 8,
        /// <summary>worn even where it would not close: stretched beyond what its fabric takes</summary>
        AnyFit = 16,
    }

    /// <summary>A prop: a solid that the host puts beside a body, such as a chair, a weapon, a bag or
    /// hair. Cloth stays outside of it by its thickness, and meets its edges too. A prop comes in as a
    /// point that grows to its size within 0.25 s and pushes cloth aside, also after vfit_cloth_reset,
    /// and where it moves by more than 0.3 m against the body within a step. Where it reaches into the
    /// body, cloth meets it outside of that, with room for the cloth between them. One that crosses cloth
    /// and stretches it to more than 1.6 times its length passes through it for a while.</summary>
    public enum PropShape : int
    {
        Sphere = 0,
        Capsule = 1,
        Box = 2,
        Mesh = 3,
    }

    /// <summary>How a garment sits at one girth of the trunk. TIGHT: the body's girth is nearer to the
    /// girth of the next larger size, and less than 5 cm of ease are left, or it presses with over 2 kPa;
    /// LOOSE: nearer to the girth of the next smaller size, with over 5 cm of ease. Of a garment that
    /// tells of no such girth, TIGHT: stretched by over 3 %; LOOSE: over 12 cm of ease.</summary>
    public enum Fit : int
    {
        Right = 0,
        Tight = 1,
        Loose = 2,
    }

    /// <summary>The surfaces that cross.</summary>
    public enum CrossingKind : int
    {
        /// <summary>the garment and itself</summary>
        Self = 0,
        /// <summary>the garment and the skin of the avatar, linearly blended</summary>
        Skin = 1,
        /// <summary>the garment and another of the list</summary>
        Cloth = 2,
        /// <summary>the garment and a prop that it meets</summary>
        Prop = 3,
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct ContextId
    {
        internal ulong Value;
        internal ContextId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct SensorId
    {
        internal ulong Value;
        internal SensorId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct FrameId
    {
        internal ulong Value;
        internal FrameId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct TrackerId
    {
        internal ulong Value;
        internal TrackerId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct ScanId
    {
        internal ulong Value;
        internal ScanId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct SizeChartId
    {
        internal ulong Value;
        internal SizeChartId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct MotionId
    {
        internal ulong Value;
        internal MotionId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct AvatarId
    {
        internal ulong Value;
        internal AvatarId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct GarmentId
    {
        internal ulong Value;
        internal GarmentId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct ClothId
    {
        internal ulong Value;
        internal ClothId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct RecorderId
    {
        internal ulong Value;
        internal RecorderId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct PropId
    {
        internal ulong Value;
        internal PropId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 8)]
    internal struct PopulationId
    {
        internal ulong Value;
        internal PopulationId(ulong value) { Value = value; }
    }

    [StructLayout(LayoutKind.Sequential, Size = 72)]
    public unsafe partial struct ContextDesc
    {
        internal uint StructSize;
        /// <summary>required: VFIT_VERSION</summary>
        public uint ApiVersion;
        /// <summary>VFIT_CONTEXT_*</summary>
        public ContextFlags Flags;
        public Axes Axes;
        internal IntPtr log;
        internal IntPtr submit;
        internal IntPtr wait;
        internal void* user;
        internal byte* pluginDir;
        internal byte* dataDir;
        /// <summary>0: physical cores less one</summary>
        public uint WorkerCount;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 136)]
    public unsafe partial struct LibraryInfo
    {
        internal uint StructSize;
        public uint Version;
        internal fixed byte simdBytes[16];
        /// <summary>instruction set in use: "AVX2", "SSE4", "SCALAR", ...</summary>
        public string Simd
        {
            get { fixed (byte* bytes = simdBytes) return Utf8Text.Read(bytes, 16); }
            set { fixed (byte* bytes = simdBytes) Utf8Text.Write(value, bytes, 16, "Simd"); }
        }
        internal fixed byte buildBytes[112];
        /// <summary>compiler and build type</summary>
        public string Build
        {
            get { fixed (byte* bytes = buildBytes) return Utf8Text.Read(bytes, 112); }
            set { fixed (byte* bytes = buildBytes) Utf8Text.Write(value, bytes, 112, "Build"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 392)]
    public unsafe partial struct PluginInfo
    {
        internal uint StructSize;
        public uint Version;
        internal fixed byte nameBytes[64];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
        internal fixed byte schemesBytes[64];
        public string Schemes
        {
            get { fixed (byte* bytes = schemesBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = schemesBytes) Utf8Text.Write(value, bytes, 64, "Schemes"); }
        }
        internal fixed byte pathBytes[256];
        public string Path
        {
            get { fixed (byte* bytes = pathBytes) return Utf8Text.Read(bytes, 256); }
            set { fixed (byte* bytes = pathBytes) Utf8Text.Write(value, bytes, 256, "Path"); }
        }
    }

    /// <summary>A file of data_dir, by the name that opens it.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 68)]
    public unsafe partial struct DataName
    {
        internal uint StructSize;
        internal fixed byte nameBytes[64];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 24)]
    public unsafe partial struct ContextStats
    {
        internal uint StructSize;
        public uint HandleCount;
        public uint FrameCount;
        public uint WorkerCount;
        /// <summary>held by this context's frames, pools included</summary>
        public ulong FrameBytes;
    }

    /// <summary>Time spent in one stage since the context was created (or since
    /// vfit_profile_reset).</summary>
    [StructLayout(LayoutKind.Sequential, Size = 64)]
    public unsafe partial struct Profile
    {
        internal uint StructSize;
        public uint Calls;
        public double LastMs;
        public double MeanMs;
        public double MaxMs;
        internal fixed byte stageBytes[32];
        public string Stage
        {
            get { fixed (byte* bytes = stageBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = stageBytes) Utf8Text.Write(value, bytes, 32, "Stage"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct View
    {
        internal uint StructSize;
        public Format Format;
        internal void* data;
        /// <summary>items; height is 1 for vertex data</summary>
        public uint Width;
        /// <summary>items; height is 1 for vertex data</summary>
        public uint Height;
        /// <summary>bytes</summary>
        public uint ItemStride;
        /// <summary>bytes</summary>
        public uint RowStride;
        public long TimeNs;
        /// <summary>equal serials of one stream: equal content</summary>
        public ulong Serial;
    }

    /// <summary>Where vfit_frame_write writes: item i at data + i * item_stride (0: packed); capacity in
    /// bytes.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 32)]
    public unsafe partial struct Target
    {
        internal uint StructSize;
        public Format Format;
        internal void* data;
        public ulong Capacity;
        public uint ItemStride;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 64)]
    public unsafe partial struct Intrinsics
    {
        internal uint StructSize;
        public uint Width;
        public uint Height;
        internal uint Reserved;
        public float Fx;
        public float Fy;
        public float Cx;
        public float Cy;
        public fixed float Distortion[8];
    }

    [StructLayout(LayoutKind.Sequential, Size = 104)]
    public unsafe partial struct Camera
    {
        internal uint StructSize;
        public FloorState FloorState;
        /// <summary>0: 0.001</summary>
        public float DepthUnitM;
        /// <summary>above the floor; tilt &gt; 0 looks down. Outputs only</summary>
        public float HeightM;
        /// <summary>above the floor; tilt &gt; 0 looks down. Outputs only</summary>
        public float TiltRad;
        /// <summary>above the floor; tilt &gt; 0 looks down. Outputs only</summary>
        public float RollRad;
        /// <summary>in camera space, pointing up: normal . p + distance = 0</summary>
        public Float3 FloorNormal;
        public float FloorDistanceM;
        /// <summary>output only; bodies are carried by it; metres whatever axes</summary>
        public Float16 WorldFromCamera;
    }

    [StructLayout(LayoutKind.Sequential, Size = 64)]
    public unsafe partial struct FrameDesc
    {
        internal uint StructSize;
        public uint Count;
        internal StreamKind* streams;
        internal View* views;
        internal Intrinsics* intrinsics;
        internal Camera* camera;
        /// <summary>0: now</summary>
        public long TimeNs;
        internal IntPtr release;
        internal void* user;
    }

    [StructLayout(LayoutKind.Sequential, Size = 392)]
    public unsafe partial struct SensorInfo
    {
        internal uint StructSize;
        public uint Caps;
        internal fixed byte uriBytes[256];
        public string Uri
        {
            get { fixed (byte* bytes = uriBytes) return Utf8Text.Read(bytes, 256); }
            set { fixed (byte* bytes = uriBytes) Utf8Text.Write(value, bytes, 256, "Uri"); }
        }
        internal fixed byte nameBytes[64];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
        internal fixed byte pluginBytes[64];
        public string Plugin
        {
            get { fixed (byte* bytes = pluginBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = pluginBytes) Utf8Text.Write(value, bytes, 64, "Plugin"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 80)]
    public unsafe partial struct SensorMode
    {
        internal uint StructSize;
        public uint Width;
        public uint Height;
        public float RateHz;
        internal fixed byte nameBytes[64];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 264)]
    public unsafe partial struct SensorOption
    {
        internal uint StructSize;
        internal uint Reserved;
        internal fixed byte keyBytes[32];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 32, "Key"); }
        }
        internal fixed byte valueBytes[96];
        public string Value
        {
            get { fixed (byte* bytes = valueBytes) return Utf8Text.Read(bytes, 96); }
            set { fixed (byte* bytes = valueBytes) Utf8Text.Write(value, bytes, 96, "Value"); }
        }
        internal fixed byte textBytes[128];
        public string Text
        {
            get { fixed (byte* bytes = textBytes) return Utf8Text.Read(bytes, 128); }
            set { fixed (byte* bytes = textBytes) Utf8Text.Write(value, bytes, 128, "Text"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct SensorStats
    {
        internal uint StructSize;
        public uint Running;
        /// <summary>OK, END_OF_STREAM, DEVICE_LOST or the plug-in's error</summary>
        public Result State;
        internal uint Reserved;
        /// <summary>frames pushed, acquired, replaced before they were acquired</summary>
        public ulong Received;
        /// <summary>frames pushed, acquired, replaced before they were acquired</summary>
        public ulong Taken;
        /// <summary>frames pushed, acquired, replaced before they were acquired</summary>
        public ulong Dropped;
        /// <summary>of the last acquire: from time stamp to hand-over</summary>
        public long LatencyNs;
    }

    [StructLayout(LayoutKind.Sequential, Size = 24)]
    public unsafe partial struct RecorderDesc
    {
        internal uint StructSize;
        internal uint Reserved;
        internal byte* sensorName;
        /// <summary>0: 30</summary>
        public float RateHz;
        /// <summary>the background was removed already</summary>
        public uint Segmented;
    }

    /// <summary>rotation: of the joint in world space, relative to a T-pose that faces +Z; all zero:
    /// unknown.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct Joint
    {
        internal uint StructSize;
        public JointId Id;
        public JointState State;
        public float Confidence;
        public Float3 Position;
        public Float4 Rotation;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 24)]
    public unsafe partial struct Body
    {
        internal uint StructSize;
        public uint BodyId;
        public long TimeNs;
        public BodyFlags Flags;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 40)]
    public unsafe partial struct TrackerDesc
    {
        internal uint StructSize;
        internal uint Reserved;
        internal Camera* floor;
        public TrackSource Joints;
        public TrackSource UserMap;
        /// <summary>the rule of the active person</summary>
        public Follow Follow;
        public JointFilter Filter;
        public TrackFit Fit;
        internal uint Reserved2;
    }

    /// <summary>Where a joint is in the depth image, as a pose network sees it in a registered colour
    /// image. LEFT is the person's own left, whatever the context mirrors.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 24)]
    public unsafe partial struct JointHint
    {
        internal uint StructSize;
        /// <summary>0: of whose pixel it is</summary>
        public uint BodyId;
        public JointId Joint;
        /// <summary>pixel; centres lie at whole coordinates</summary>
        public float X;
        /// <summary>pixel; centres lie at whole coordinates</summary>
        public float Y;
        /// <summary>0..1: the chance that it is right</summary>
        public float Confidence;
    }

    [StructLayout(LayoutKind.Sequential, Size = 28)]
    public unsafe partial struct ScanDesc
    {
        internal uint StructSize;
        public ScanMethod Method;
        /// <summary>0: 30, as in the paper</summary>
        public uint FrameCount;
        public Sex Sex;
        /// <summary>of FIT: frames from the side, 15 are enough; 0: none are waited for</summary>
        public uint SideFrameCount;
        /// <summary>VFIT_SCAN_*</summary>
        public ScanFlags Flags;
        /// <summary>of FIT: cameras that see the person at the same time (vfit_scan_add_from), at most 8; 0:
        /// one. Where they show front, back and a side, girths of the trunk are measured on the closed
        /// surface and combined with the others. Not with VFIT_SCAN_TURN</summary>
        public uint CameraCount;
    }

    [StructLayout(LayoutKind.Sequential, Size = 40)]
    public unsafe partial struct ScanState
    {
        internal uint StructSize;
        public uint FramesTaken;
        public uint FramesWanted;
        /// <summary>why the last frame was not taken</summary>
        public Guidance Guidance;
        /// <summary>mean absolute change of depth by the filter (Fig. 9)</summary>
        public float CorrectionM;
        /// <summary>of the last frame</summary>
        public float ComputeMs;
        /// <summary>frames_taken: from the front Of a turn, a bit for each of VFIT_TURN_WAYS ways to face:
        /// bit i is i times 15 degrees to the person's left of facing the camera. turn_wanted 0: no turn is
        /// asked for.</summary>
        public uint SideFramesTaken;
        /// <summary>frames_taken: from the front Of a turn, a bit for each of VFIT_TURN_WAYS ways to face:
        /// bit i is i times 15 degrees to the person's left of facing the camera. turn_wanted 0: no turn is
        /// asked for.</summary>
        public uint SideFramesWanted;
        public uint TurnSeen;
        public uint TurnWanted;
    }

    /// <summary>key: "stature_m", "chest_girth_m", "body_mass_kg", ... (vfit_measure_key): the unit is in
    /// the key; observed 0: inferred from others. sigma is one standard deviation of value; 0:
    /// unknown.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 64)]
    public unsafe partial struct Measurement
    {
        internal uint StructSize;
        public uint Observed;
        public float Value;
        public float Sigma;
        internal fixed byte keyBytes[48];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
    }

    /// <summary>A sphere (joint_b -1), or the tapered capsule of two spheres.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct Collider
    {
        internal uint StructSize;
        public JointId Joint;
        public Float3 Center;
        public float Radius;
        public JointId JointB;
        public Float3 CenterB;
        public float RadiusB;
        internal uint Reserved;
    }

    /// <summary>Algorithm 3: x and y relative to the nominal width and height of a garment kind
    /// ("short_sleeves", "long_sleeves", "trousers"); apply to body and garment as a whole, width and
    /// depth by x.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 32)]
    public unsafe partial struct Scale
    {
        internal uint StructSize;
        public float X;
        public float Y;
        public float SigmaX;
        public float SigmaY;
        public float WidthM;
        public float HeightM;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 40)]
    public unsafe partial struct Size
    {
        internal uint StructSize;
        public float Probability;
        internal fixed byte labelBytes[32];
        public string Label
        {
            get { fixed (byte* bytes = labelBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = labelBytes) Utf8Text.Write(value, bytes, 32, "Label"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 72)]
    public unsafe partial struct SizeRow
    {
        internal uint StructSize;
        public uint MeasureCount;
        internal fixed byte garmentKindBytes[32];
        public string GarmentKind
        {
            get { fixed (byte* bytes = garmentKindBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = garmentKindBytes) Utf8Text.Write(value, bytes, 32, "GarmentKind"); }
        }
        internal fixed byte labelBytes[32];
        public string Label
        {
            get { fixed (byte* bytes = labelBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = labelBytes) Utf8Text.Write(value, bytes, 32, "Label"); }
        }
    }

    /// <summary>How a size sits by one measure: ease is the room beyond the body in the middle of the
    /// size's range (below 0: too little of it), sigma its deviation; probabilities that the body is
    /// above, within and below that range.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 72)]
    public unsafe partial struct SizeZone
    {
        internal uint StructSize;
        public float Ease;
        public float Sigma;
        public float Tight;
        public float Regular;
        public float Loose;
        internal fixed byte keyBytes[48];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
    }

    /// <summary>What a shop's own tape says of scans of the same people, by measure. enough 0: too few
    /// people, nothing is changed.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 68)]
    public unsafe partial struct CalibratedMeasure
    {
        internal uint StructSize;
        public uint People;
        public uint Enough;
        /// <summary>of the tape from the scan, in the key's unit</summary>
        public float Offset;
        /// <summary>of sigma</summary>
        public float Widening;
        internal fixed byte keyBytes[48];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
    }

    /// <summary>Of whom measures are estimated.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 16)]
    public unsafe partial struct Person
    {
        internal uint StructSize;
        /// <summary>VFIT_SEX_UNKNOWN: both are mixed by how well the measures suit each</summary>
        public Sex Sex;
        /// <summary>18 to 100; 0: not told</summary>
        public float AgeYears;
        internal uint Reserved;
    }

    /// <summary>A measure that does not go with the others of its list.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 120)]
    public unsafe partial struct Doubt
    {
        internal uint StructSize;
        public DoubtKind Kind;
        /// <summary>as it was given</summary>
        public float Value;
        /// <summary>what the slip makes of it; of VFIT_DOUBT_UNLIKELY: as expected</summary>
        public float Suggested;
        /// <summary>by the others</summary>
        public float Expected;
        /// <summary>by the others</summary>
        public float Sigma;
        internal fixed byte keyBytes[48];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
        internal fixed byte otherKeyBytes[48];
        public string OtherKey
        {
            get { fixed (byte* bytes = otherKeyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = otherKeyBytes) Utf8Text.Write(value, bytes, 48, "OtherKey"); }
        }
    }

    /// <summary>rotation is local to the parent and relative to a T-pose in which every bone has the axes
    /// of the world (so that rest is the identity); position is the hips' in world space, else the offset
    /// from the parent in that T-pose.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 40)]
    public unsafe partial struct Bone
    {
        internal uint StructSize;
        public BoneId Id;
        public Float4 Rotation;
        public Float3 Position;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 32)]
    public unsafe partial struct Pose
    {
        internal uint StructSize;
        public ContactFlags ContactFlags;
        public long TimeNs;
        /// <summary>what the foot stage moved the root by (Alg. 6, d_root)</summary>
        public Float3 RootCorrection;
        /// <summary>how far it moved the planted foot (Fig. 11)</summary>
        public float FootCorrectionM;
    }

    /// <summary>Of the floats, 0 means the default and &lt; 0 means 0 (where 0 is in the
    /// range).</summary>
    [StructLayout(LayoutKind.Sequential, Size = 72)]
    public unsafe partial struct MotionDesc
    {
        internal uint StructSize;
        /// <summary>VFIT_MOTION_*</summary>
        public MotionFlags Flags;
        /// <summary>0..1; default 0.5, 0.5, 0.5</summary>
        public float Smoothing;
        /// <summary>0..1; default 0.5, 0.5, 0.5</summary>
        public float Correction;
        /// <summary>0..1; default 0.5, 0.5, 0.5</summary>
        public float Prediction;
        /// <summary>default 0.05, 0.04</summary>
        public float JitterRadiusM;
        /// <summary>default 0.05, 0.04</summary>
        public float MaxDeviationRadiusM;
        /// <summary>k of Eq. 10 at 30 Hz; default 2</summary>
        public float RotationDivisor;
        /// <summary>k right after the planted foot changed; default 4</summary>
        public float RotationDivisorSwitched;
        public PositionFilter Filter;
        /// <summary>One Euro; default 1, 1 (Hz for each m/s), 1</summary>
        public float MinCutoffHz;
        /// <summary>One Euro; default 1, 1 (Hz for each m/s), 1</summary>
        public float Beta;
        /// <summary>One Euro; default 1, 1 (Hz for each m/s), 1</summary>
        public float DerivativeCutoffHz;
        /// <summary>looks ahead of now_ns, to hide latency: 0..0.2; default 0</summary>
        public float PredictionS;
        public ContactRule ContactRule;
        internal uint Reserved;
        internal byte* rangeOfMotion;
    }

    [StructLayout(LayoutKind.Sequential, Size = 16)]
    public unsafe partial struct AvatarDesc
    {
        internal uint StructSize;
        public AvatarFlags Flags;
        /// <summary>which default body; UNKNOWN: halfway</summary>
        public Sex Sex;
        /// <summary>0: 13.7k vertices, 1: 54.8k, 2: 219k, 3: 1.0k, for crowds</summary>
        public uint Detail;
    }

    /// <summary>key: a phenotype ("gender", "age", "muscle", "weight", "height", "proportions", in 0..1;
    /// weight up to 1.15) or a local slider ("measure-waist-circ", in -1..1); see
    /// vfit_shape_list.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 64)]
    public unsafe partial struct ShapeValue
    {
        internal uint StructSize;
        public float Value;
        public float Minimum;
        public float Maximum;
        internal fixed byte keyBytes[48];
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 96)]
    public unsafe partial struct RigBone
    {
        internal uint StructSize;
        /// <summary>-1: root; parents stand before children</summary>
        public int Parent;
        /// <summary>the humanoid bone that it is, or -1</summary>
        public BoneId Bone;
        /// <summary>of the bone's head, in the space of the rest mesh</summary>
        public Float3 RestPosition;
        internal fixed byte nameBytes[48];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 48, "Name"); }
        }
        /// <summary>of the bone's own axes there: posed, they are BONE_MATRIX * rest</summary>
        public Float4 RestRotation;
        /// <summary>of the character's file; -1: made by vfit</summary>
        public int Node;
        internal uint Reserved;
    }

    /// <summary>A character of yours: a skinned humanoid from a glTF 2.0 (.glb, .gltf) or VRM 0 or 1
    /// file.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 40)]
    public unsafe partial struct CharacterDesc
    {
        internal uint StructSize;
        /// <summary>metres in a unit of the file; 0: 1, as glTF says</summary>
        public float Scale;
        internal byte* path;
        internal void* bytes;
        public ulong ByteCount;
        internal byte* boneMap;
    }

    [StructLayout(LayoutKind.Sequential, Size = 160)]
    public unsafe partial struct CharacterInfo
    {
        internal uint StructSize;
        public CharacterKind Kind;
        public uint VertexCount;
        public uint IndexCount;
        public uint BoneCount;
        public uint PartCount;
        /// <summary>floor to crown, feet together</summary>
        public float StatureM;
        /// <summary>rest mesh = M * the file's world; right-handed metres whatever axes</summary>
        public Float16 FromFile;
        internal fixed byte nameBytes[64];
        /// <summary>as VRM tells it</summary>
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
        internal uint Reserved;
    }

    /// <summary>Triangles of one material of the file: indices first_index on. vfit's own body is one
    /// part without.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 112)]
    public unsafe partial struct AvatarPart
    {
        internal uint StructSize;
        public uint FirstIndex;
        public uint IndexCount;
        public int Material;
        internal fixed byte meshBytes[48];
        public string Mesh
        {
            get { fixed (byte* bytes = meshBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = meshBytes) Utf8Text.Write(value, bytes, 48, "Mesh"); }
        }
        internal fixed byte materialNameBytes[48];
        public string MaterialName
        {
            get { fixed (byte* bytes = materialNameBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = materialNameBytes) Utf8Text.Write(value, bytes, 48, "MaterialName"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 208)]
    public unsafe partial struct GarmentInfo
    {
        internal uint StructSize;
        public uint VertexCount;
        public uint SimulatedCount;
        public uint SizeCount;
        internal fixed byte nameBytes[64];
        public string Name
        {
            get { fixed (byte* bytes = nameBytes) return Utf8Text.Read(bytes, 64); }
            set { fixed (byte* bytes = nameBytes) Utf8Text.Write(value, bytes, 64, "Name"); }
        }
        internal fixed byte garmentKindBytes[32];
        /// <summary>as size charts name it</summary>
        public string GarmentKind
        {
            get { fixed (byte* bytes = garmentKindBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = garmentKindBytes) Utf8Text.Write(value, bytes, 32, "GarmentKind"); }
        }
        internal fixed byte fabricBytes[32];
        public string Fabric
        {
            get { fixed (byte* bytes = fabricBytes) return Utf8Text.Read(bytes, 32); }
            set { fixed (byte* bytes = fabricBytes) Utf8Text.Write(value, bytes, 32, "Fabric"); }
        }
        internal fixed byte sizeChartBytes[60];
        /// <summary>name of the chart that its labels follow; empty: the file states none</summary>
        public string SizeChart
        {
            get { fixed (byte* bytes = sizeChartBytes) return Utf8Text.Read(bytes, 60); }
            set { fixed (byte* bytes = sizeChartBytes) Utf8Text.Write(value, bytes, 60, "SizeChart"); }
        }
        /// <summary>of the default body that it was made on</summary>
        public Sex BodySex;
    }

    /// <summary>Triangles of one look: indices first_index on of what vfit_cloth_acquire gives. texture:
    /// the path of a picture as the garment's author gave it, or empty; color: linear RGB.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 272)]
    public unsafe partial struct GarmentPart
    {
        internal uint StructSize;
        public uint FirstIndex;
        public uint IndexCount;
        public Float3 Color;
        internal fixed byte materialBytes[48];
        public string Material
        {
            get { fixed (byte* bytes = materialBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = materialBytes) Utf8Text.Write(value, bytes, 48, "Material"); }
        }
        internal fixed byte textureBytes[200];
        public string Texture
        {
            get { fixed (byte* bytes = textureBytes) return Utf8Text.Read(bytes, 200); }
            set { fixed (byte* bytes = textureBytes) Utf8Text.Write(value, bytes, 200, "Texture"); }
        }
    }

    [StructLayout(LayoutKind.Sequential, Size = 96)]
    public unsafe partial struct ClothDesc
    {
        internal uint StructSize;
        /// <summary>0: 8 a 1/60 s; on the skin up to eight times as many in a step in which parts of the body
        /// move fast</summary>
        public uint Substeps;
        /// <summary>in the context's axes and unit; all zero: 9.81 m/s2 down</summary>
        public Float3 Gravity;
        /// <summary>0: the fabric's; &lt; 0: none</summary>
        public float Friction;
        /// <summary>share of speed lost a second, 0: 0.5; &lt; 0: none</summary>
        public float Damping;
        /// <summary>kept from the colliders, 0: 0.004</summary>
        public float ThicknessM;
        internal byte* sizeLabel;
        /// <summary>VFIT_CLOTH_*</summary>
        public ClothFlags Flags;
        internal uint Reserved;
        /// <summary>as vfit_cloth_set_wind</summary>
        public Float3 Wind;
        /// <summary>of the air, as of a plate: about 1; both 0: no air</summary>
        public float Drag;
        /// <summary>of the air, as of a plate: about 1; both 0: no air</summary>
        public float Lift;
        /// <summary>share of the body's own motion that the cloth feels, 0: all; &lt; 0: none</summary>
        public float Inertia;
        /// <summary>kept between the cloth's own layers, 0: they pass through each other</summary>
        public float SelfThicknessM;
        /// <summary>of a step, 0: none. See vfit_cloth_set_quality</summary>
        public float BudgetMs;
        /// <summary>more spheres and capsules, until no skin below the garment, but hands and feet, is so far
        /// outside of all; 0.005..0.1; 0: the avatar's 31 alone</summary>
        public float CoverM;
        /// <summary>points of triangles meet spheres and capsules as vertices do: so many that none is
        /// further from the next, 65,536 at most; 0.001..0.1; 0: none. For meshes coarser than a
        /// wrist</summary>
        public float VirtualM;
        /// <summary>a step in which the garment, as the bones move it, or a limb of it against</summary>
        public float CarrySpeedMS;
        /// <summary>the rest, gains more speed on the step before, or all of it goes further, is a jump, as
        /// after vfit_cloth_teleport. 0: 6, and 0.06; &lt; 0: no limit</summary>
        public float CarryWayM;
    }

    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct ClothStats
    {
        internal uint StructSize;
        /// <summary>Of edges: 1 is twice the rest length; of edges below 2 cm strain_max is a fraction of 2
        /// cm.</summary>
        public uint VertexCount;
        /// <summary>Of edges: 1 is twice the rest length; of edges below 2 cm strain_max is a fraction of 2
        /// cm.</summary>
        public uint SimulatedCount;
        /// <summary>Of edges: 1 is twice the rest length; of edges below 2 cm strain_max is a fraction of 2
        /// cm.</summary>
        public uint ConstraintCount;
        public float StrainMean;
        public float StrainP99;
        public float StrainMax;
        public float StepMs;
        /// <summary>of the last step; 0: it slept</summary>
        public uint Substeps;
        /// <summary>spheres and capsules that it met So much too long, in metres, were sleeves and legs for
        /// these limbs: they were taken up to wrist and ankle, but for what folds take
        /// (docs/garments.md).</summary>
        public uint ColliderCount;
        public float SleevesTakenUpM;
        public float LegsTakenUpM;
    }

    [StructLayout(LayoutKind.Sequential, Size = 48)]
    public unsafe partial struct PropDesc
    {
        internal uint StructSize;
        public PropShape Shape;
        /// <summary>context's axes and unit, 1 mm to 10 m. SPHERE: radius. CAPSULE: radius, and half the way
        /// between its two centres, which lie along the up axis. BOX: half of each edge</summary>
        public Float3 Size;
        /// <summary>65,536 at most, also once edges longer than 3 cm (and 1/40 of its extent) are split: then
        /// VFIT_ERROR_DATA</summary>
        public uint VertexCount;
        internal float* positions;
        internal uint* indices;
        /// <summary>1,048,575 at most</summary>
        public uint IndexCount;
        internal uint Reserved;
    }

    [StructLayout(LayoutKind.Sequential, Size = 80)]
    public unsafe partial struct FitZone
    {
        internal uint StructSize;
        public Fit Fit;
        /// <summary>the avatar's girth</summary>
        public float BodyM;
        /// <summary>of the cloth that lies around it, unstretched</summary>
        public float GarmentM;
        /// <summary>garment less body</summary>
        public float EaseM;
        /// <summary>of that cloth along the girth, as it is worn</summary>
        public float Strain;
        /// <summary>mean about the girth; with VFIT_CLOTH_PRESSURE</summary>
        public float PressurePa;
        /// <summary>across an open front, beside garment_m; 0: closed</summary>
        public float OpeningM;
        internal fixed byte keyBytes[48];
        /// <summary>"chest_girth_m", "waist_girth_m", "hip_girth_m"</summary>
        public string Key
        {
            get { fixed (byte* bytes = keyBytes) return Utf8Text.Read(bytes, 48); }
            set { fixed (byte* bytes = keyBytes) Utf8Text.Write(value, bytes, 48, "Key"); }
        }
    }

    /// <summary>Two surfaces of an outfit of which triangles cross.</summary>
    [StructLayout(LayoutKind.Sequential, Size = 32)]
    public unsafe partial struct Crossing
    {
        internal uint StructSize;
        public CrossingKind Kind;
        /// <summary>index in cloths</summary>
        public uint Cloth;
        /// <summary>of CLOTH: index of the other one; of PROP: its number among the props of cloth in that
        /// step, in the order in which they were added; else as cloth</summary>
        public uint Other;
        /// <summary>pairs of triangles that cross</summary>
        public uint PairCount;
        /// <summary>of the first pair: number in the INDEX stream of cloth</summary>
        public uint Triangle;
        /// <summary>number in the INDEX stream of cloth, of the avatar, or of other, by kind; of PROP:
        /// 0</summary>
        public uint OtherTriangle;
        internal uint Reserved;
    }

    /// <summary>Numbers of the header that this binding was made from.</summary>
    public static class Counts
    {
        public const int JointCount = 23;
        public const int BoneCount = 22;
        internal const uint HeaderVersion = 0u << 22 | 2u << 12 | 0u;
    }
}
