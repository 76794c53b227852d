// Written by scripts/csharp-bindings from include/vfit.h: change that, then run the script.
using System;
using System.Runtime.InteropServices;

namespace Vfit
{
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void LogFn(IntPtr user, LogLevel level, byte* message);

    /// <summary>The host's job system: submit starts count items and returns a job, wait returns when all
    /// have run. Both are called only on a thread that is inside a vfit call. An item never waits for one
    /// that has not started; one worker alone completes any step. A null job means that all items have
    /// run already.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void TaskFn(IntPtr task, uint index);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate IntPtr SubmitFn(IntPtr user, IntPtr fn, IntPtr task, uint count);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void WaitFn(IntPtr user, IntPtr job);

    /// <summary>A frame from pixels of the host (its own camera): views[i] is stream streams[i]. The
    /// pixels are copied unless release is given, which is then called once, from any thread, when the
    /// last reference has gone (and not at all where the call fails). Lent pixels are packed and aligned
    /// to their format.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    internal unsafe delegate void ReleaseFn(IntPtr user);

    internal static unsafe class Native
    {
#if UNITY_IOS && !UNITY_EDITOR
        private const string Library = "__Internal";
#else
        private const string Library = "vfit";
#endif

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_version();

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_library_describe(LibraryInfo* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* vfit_result_name(Result result);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_last_error(byte* buffer, uint capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_context_create(ContextDesc* desc, ContextId* @out);

        /// <summary>joins all threads [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_context_destroy(ContextId context);

        /// <summary>all contexts; for a host that reloads [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_shutdown();

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_context_describe(ContextId context, ContextStats* @out);

        /// <summary>Now, on the clock of all time stamps of this context. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_context_time(ContextId context, long* timeNs);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_profile_list(ContextId context, Profile* items, uint stride,
            uint* count);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_profile_reset(ContextId context);

        /// <summary>The next log line where no callback is wanted (Unity reloads, Python); VFIT_NOT_READY:
        /// none. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_log_next(ContextId context, LogLevel* level, byte* buffer,
            uint capacity);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_plugin_load(ContextId context, byte* path);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_plugin_list(ContextId context, PluginInfo* items, uint stride,
            uint* count);

        /// <summary>Names "HEAD", "LEFT_ELBOW"; "hips", "leftUpperArm". An unknown id gives length 0 and an
        /// empty text. The parent of the first bone is -1; of an unknown one -2. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_joint_name(JointId joint, byte* buffer, uint capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_bone_name(BoneId bone, byte* buffer, uint capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int vfit_bone_parent(BoneId bone);

        /// <summary>Key ("chest_girth_m") and one-line definition of the measure at index; length 0 past the
        /// last. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_measure_key(uint index, byte* buffer, uint capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_measure_text(uint index, byte* buffer, uint capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_create(ContextId context, FrameDesc* desc, FrameId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_retain(FrameId frame);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_release(FrameId frame);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_streams(FrameId frame, StreamKind* items, uint* count);

        /// <summary>[any] [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_view(FrameId frame, StreamKind stream, View* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_intrinsics(FrameId frame, Intrinsics* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_camera(FrameId frame, Camera* @out);

        /// <summary>What the source says beside the pixels, one JSON document a key: "measures" (ground truth
        /// of a virtual person, {"stature_m": ...}), "contacts" (of feet, {"left": 0, "right": 1}: 0 free, 1
        /// the whole foot stands, 2 only its heel or ball does), "index" (the number of a recorded frame),
        /// "bodies" (true: the source tells its bodies, also when no person is in view); and of a frame in
        /// which the built-in tracker found no body, "no_person" ("nothing is within 6 m", ...: why). *length
        /// is the whole text's; no such key: VFIT_NOT_READY. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_meta(FrameId frame, byte* key, byte* buffer, uint capacity,
            uint* length);

        /// <summary>Copies into memory of the engine (mapped vertex buffer, NativeArray) at its own format
        /// and stride; VFIT_NOT_READY and no copy if *serial is already that of the frame. serial may be
        /// null. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_write(FrameId frame, StreamKind stream, Target* target,
            ulong* serial);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_list(ContextId context, SensorInfo* items, uint stride,
            uint* count);

        /// <summary>Rises when the list may have become another: a USB camera of a kind that a plug-in knows
        /// was plugged in or unplugged, a plug-in was loaded. Cheap: ask each frame, and list again when it
        /// has changed. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_changes(ContextId context, ulong* count);

        /// <summary>Opens a source: a path, or a URI "SCHEME:ADDRESS?KEY=VALUE&amp;KEY=VALUE", such as
        /// "recording:PATH?loop=1&amp;start=5", "oni:PATH?start=3" or "openni2:?registration=0". The virtual
        /// person has no address: "virtual:motion=demo&amp;sex=f". Each option is set, and fails, as by
        /// vfit_sensor_set_option; a key stands at most once. %XX is one byte: %3F is a ? in a path, %26 an
        /// &amp; in a value. A path is not decoded: an existing folder is a recording, an existing file goes
        /// by its extension, and options may follow: "PATH?start=5". The longest existing path counts, so
        /// that a path that exists as written has no options. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_open(ContextId context, byte* uri, SensorId* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_modes(SensorId sensor, SensorMode* items, uint stride,
            uint* count);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_options(SensorId sensor, SensorOption* items, uint stride,
            uint* count);

        /// <summary>Options of every sensor: "mode" (a name from vfit_sensor_modes) and "pace": "realtime"
        /// drops as a camera does; "none" (the default of recordings and of the virtual person) makes a push
        /// wait until the frame before was taken, so that nothing is dropped. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_set_option(SensorId sensor, byte* key, byte* value);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_start(SensorId sensor);

        /// <summary>wakes waiting acquires [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_stop(SensorId sensor);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_close(SensorId sensor);

        /// <summary>The newest frame, once; VFIT_END_OF_STREAM when a replay has ended; the error of the
        /// stream when it failed. timeout_ns 0 never waits: call it so from a render loop; &lt; 0 waits
        /// without end. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_acquire(SensorId sensor, long timeoutNs, FrameId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_sensor_describe(SensorId sensor, SensorStats* @out);

        /// <summary>path must not exist or be an empty folder. What was written stays readable if the process
        /// dies: each file is complete before its name appears. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_recorder_create(ContextId context, byte* path, RecorderDesc* desc,
            RecorderId* @out);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_recorder_write(RecorderId recorder, FrameId frame);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_recorder_destroy(RecorderId recorder);

        /// <summary>Bodies are part of a tracked frame (or of a recording's, or of the host's own).
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_bodies(FrameId frame, Body* items, uint stride, uint* count);

        /// <summary>Only joints that are seen or inferred are listed. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_joints(FrameId frame, uint bodyId, Joint* items,
            uint stride, uint* count);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_create(ContextId context, TrackerDesc* desc,
            TrackerId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_destroy(TrackerId tracker);

        /// <summary>tracked shares the images and user map of frame and holds the bodies that its source
        /// supplies, or those that the tracker sees in it. Where it looks for people by itself *tracked has a
        /// user map of its own, with the ids of its source's bodies where those are taken. VFIT_ERROR_PLUGIN
        /// where the tracker has to find joints and the network module is not installed; VFIT_ERROR_IO or
        /// VFIT_ERROR_DATA, naming the file, where weights or body data cannot be read. VFIT_ERROR_DATA with
        /// the cause where the first depth that it looks into can be none: a wrong unit, raw disparities,
        /// impossible intrinsics. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_update(TrackerId tracker, FrameId frame, FrameId* tracked);

        /// <summary>The host's own middleware in place of the built-in tracker, one call a body; frame may be
        /// a *tracked of the call before, to add a second body. A joint that is not finite gives
        /// VFIT_ERROR_DATA. Positions are filtered over the calls with one body_id, by time_ns, unless
        /// desc.filter is OFF. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_submit(TrackerId tracker, FrameId frame, Body* body,
            Joint* items, uint stride, uint count, FrameId* tracked);

        /// <summary>For the next update alone, in place of earlier ones: where the tracker's own network
        /// wavers between places of a joint, the hinted one counts more (across the view; depth is the depth
        /// image's). Does little where the network is sure, and nothing far from anybody or where the joints
        /// are the source's. Bad items: VFIT_ERROR_ARGUMENT or VFIT_ERROR_DATA, none of them is taken.
        /// [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_hint(TrackerId tracker, JointHint* items, uint stride,
            uint count);

        /// <summary>A person of another camera's tracked frame, at most about 50 ms old, for the next update
        /// alone. It helps to decide which way the person faces: front and back look alike in depth. The
        /// evidence of single frames is added up over the cameras; a body of a source or of the host counts
        /// as certain. position and rotation (x, y, z, w): the pose of the other camera's world space in this
        /// one's (vfit_world_align), to 0.3 m at the person and 20 degrees. VFIT_INCOMPLETE: seen has no such
        /// body, as while the active person is lost. Further calls add people or cameras, up to 8:
        /// VFIT_ERROR_CAPACITY. No effect where the source supplies the joints. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_hint_from(TrackerId tracker, FrameId seen, uint bodyId,
            float* position, float* rotation);

        /// <summary>The pose of another camera's world space in this one's, from count points (3 floats each)
        /// that both cameras saw at the same times: joints of a person who walks about, MIDDLE joints, as
        /// left and right may be exchanged. Up is the same in both. Outliers get little weight. rms (may be
        /// null) is the weighted residual. Fewer than 8 points, points within 0.3 m of their mean, or not
        /// within 1 km: VFIT_ERROR_DATA. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_world_align(ContextId context, float* here, float* there,
            uint count, float* position, float* rotation, float* rms);

        /// <summary>Forgets people, room and choice. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_reset(TrackerId tracker);

        /// <summary>From the next update or submit on that person is the active one, whatever the rule; 0: by
        /// the rule again. Who is not in view is waited for, then the rule holds again; with
        /// VFIT_FOLLOW_CHOSEN for ever. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_tracker_set_active(TrackerId tracker, uint bodyId);

        /// <summary>The body to hand to vfit_scan_add and vfit_motion_step: the active one; 0: nobody. Of a
        /// frame that no tracker made: its first body. state may be null. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_frame_active_body(FrameId frame, uint* bodyId, ActiveState* state);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_create(ContextId context, ScanDesc* desc, ScanId* @out);

        /// <summary>wipes the body data [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_destroy(ScanId scan);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_reset(ScanId scan);

        /// <summary>Asks for more frames of this person from the front and the side, also of a complete scan,
        /// which then goes on; vfit_scan_reset takes it back. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_extend(ScanId scan, uint frames, uint sideFrames);

        /// <summary>VFIT_INCOMPLETE: the frame was not taken, state-&gt;guidance says why. VFIT_NOT_READY:
        /// taken, more are wanted. VFIT_OK: the scan is complete (further frames are ignored). state may be
        /// null. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_add(ScanId scan, FrameId tracked, uint bodyId,
            ScanState* state);

        /// <summary>A frame of one of several cameras, each with its own tracker; camera counts from 0. The
        /// scan takes front views first, then side views, from any camera, then three frames of each camera;
        /// turn_seen holds the ways of these. guidance concerns this camera; once it has shown enough, the
        /// first camera that lacks frames. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_add_from(ScanId scan, uint camera, FrameId tracked,
            uint bodyId, ScanState* state);

        /// <summary>From the first frame on; the values settle with each. No frame yet: VFIT_ERROR_STATE.
        /// [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_measure(ScanId scan, Measurement* items, uint stride,
            uint* count);

        /// <summary>The sex that the scan was told, else the likelier one, with its probability (1 where it
        /// was told). A scan by proportions infers none: VFIT_SEX_UNKNOWN, 0. probability may be null. No
        /// frame yet: VFIT_ERROR_STATE. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_sex(ScanId scan, Sex* sex, float* probability);

        /// <summary>centres are those of the last frame [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_colliders(ScanId scan, Collider* items, uint stride,
            uint* count);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_scan_scale(ScanId scan, byte* garmentKind, Scale* @out);

        /// <summary>Measurements as JSON text, for an app that keeps them with the person's consent
        /// (docs/measuring.md). text null sets *capacity to what is needed, the end included; too little:
        /// VFIT_ERROR_CAPACITY, and the same. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_measurements_write(Measurement* items, uint stride, uint count,
            Sex sex, byte* text, uint* capacity);

        /// <summary>That text, a report of vfit measure, or {"stature_m": 1.7}. sex may be null. A value that
        /// no person has, such as 172 for stature_m: VFIT_ERROR_DATA with the probable unit. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_measurements_read(void* text, ulong byteCount, Measurement* items,
            uint stride, uint* count, Sex* sex);

        /// <summary>Two scans of one person in one list. The statures of two people: VFIT_ERROR_DATA.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_measurements_merge(Measurement* a, uint aStride, uint aCount,
            Measurement* b, uint bStride, uint bCount, Measurement* items, uint stride, uint* count);

        /// <summary>Calibration to a shop's own tape, kept by the app as JSON text that holds errors alone,
        /// no bodies (docs/measuring.md). vfit_calibration_add: of one more person what a scan told, with
        /// sigma, and what the tape told; text null and byte_count 0: the first one. out null sets *capacity
        /// to what is needed; too little: VFIT_ERROR_CAPACITY, and the same. No measure in common:
        /// VFIT_ERROR_DATA. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_calibration_add(void* text, ulong byteCount, Measurement* scanned,
            uint scannedStride, uint scannedCount, Measurement* taped, uint tapedStride, uint tapedCount,
            byte* @out, uint* capacity);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_calibration_measures(void* text, ulong byteCount,
            CalibratedMeasure* items, uint stride, uint* count);

        /// <summary>Measures of a scan as that tape would tell them: for each measure with at least 20 people
        /// the value is moved by the offset, and sigma is such that at least 90 % of further people lie
        /// within 1.645 of it. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_calibration_apply(void* text, ulong byteCount,
            Measurement* scanned, uint scannedStride, uint scannedCount, Measurement* items, uint stride,
            uint* count);

        /// <summary>How the measures of people go together (docs/measuring.md): what the measures that a
        /// person knows make likely of all the others. Names of those in data_dir/populations, in
        /// alphabetical order. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_list(ContextId context, DataName* items, uint stride,
            uint* count);

        /// <summary>A population as JSON, or by the name of a file in data_dir/populations. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_load(ContextId context, void* bytes, ulong byteCount,
            PopulationId* @out);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_open(ContextId context, byte* name, PopulationId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_destroy(PopulationId population);

        /// <summary>Every measure that the population has, of a person of whom those in known are known:
        /// typed, taped or scanned, each with its sigma (0: as exact as people know it of themselves). person
        /// null: sex and age unknown. Given measures are observed and come closer to what the others say; of
        /// the others value and sigma are what is likely. Measures that the population has not are passed
        /// through. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_estimate(PopulationId population, Person* person,
            Measurement* known, uint knownStride, uint knownCount, Measurement* items, uint stride,
            uint* count);

        /// <summary>Which of these is probably wrong? An item for each measure that does not go with the
        /// others, the worst first; none is often right: with two measures it cannot be told which one it is.
        /// [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_population_check(PopulationId population, Person* person,
            Measurement* known, uint knownStride, uint knownCount, Doubt* items, uint stride, uint* count);

        /// <summary>Names of the size charts in data_dir/charts, in alphabetical order. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_chart_list(ContextId context, DataName* items, uint stride,
            uint* count);

        /// <summary>A chart as JSON (docs/size-charts.md), or by the name of a file in data_dir/charts.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_chart_load(ContextId context, void* bytes, ulong byteCount,
            SizeChartId* @out);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_chart_open(ContextId context, byte* name, SizeChartId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_chart_destroy(SizeChartId chart);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_chart_rows(SizeChartId chart, SizeRow* items, uint stride,
            uint* count);

        /// <summary>Every label of that garment kind with its probability, best first; they sum to 1. A
        /// garment of one size needs no measurement. A value that no person has: VFIT_ERROR_DATA.
        /// [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_recommend(SizeChartId chart, byte* garmentKind,
            Measurement* items, uint stride, uint count, Size* sizes, uint sizeStride, uint* sizeCount);

        /// <summary>How that size sits: an item a measure of the garment kind that was given.
        /// [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_size_zones(SizeChartId chart, byte* garmentKind, byte* label,
            Measurement* items, uint stride, uint count, SizeZone* zones, uint zoneStride, uint* zoneCount);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_create(ContextId context, MotionDesc* desc, MotionId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_destroy(MotionId motion);

        /// <summary>[excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_reset(MotionId motion);

        /// <summary>The proportions that the feet are planted with; without: those of the tracked person.
        /// [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_bind(MotionId motion, AvatarId avatar);

        /// <summary>A body whose time_ns differs from the last is new; the same or a null frame: the filter
        /// predicts to now_ns, so that a 30 Hz camera drives a 600 Hz renderer. Body not in the frame:
        /// VFIT_NOT_READY, the pose holds. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_step(MotionId motion, FrameId tracked, uint bodyId,
            long nowNs);

        /// <summary>The same with a body that no frame carries: the joints of any middleware, without a
        /// camera, in world space. body.time_ns is the time of the reading; time_ns, now_ns and
        /// VFIT_NOT_READY as above. VFIT_NOT_READY also where the joints do not place the trunk.
        /// VFIT_ERROR_ARGUMENT with VFIT_BODY_CAMERA_SPACE: without a frame there is no camera.
        /// [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_step_body(MotionId motion, Body* body, Joint* items,
            uint stride, uint count, long nowNs);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_pose(MotionId motion, Pose* pose, Bone* items, uint stride,
            uint* count);

        /// <summary>A pose for the network, at most 120 bytes: rotations to 0.1 degrees, the hips to 0.1 mm,
        /// contacts, time. bytes null sets *byte_count to what is needed. It is the same whatever the axes of
        /// the two contexts. Unpacked bones come as from vfit_motion_pose, but for positions of all but the
        /// hips, which are the receiver's avatar's own: zero. Hips over 800 m away: VFIT_ERROR_DATA; a packet
        /// of another version: VFIT_ERROR_VERSION; a damaged one: VFIT_ERROR_DATA. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_pose_pack(ContextId context, Pose* pose, Bone* items, uint stride,
            uint count, void* bytes, uint* byteCount);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_pose_unpack(ContextId context, void* bytes, uint byteCount,
            Pose* pose, Bone* items, uint stride, uint* count);

        /// <summary>Both are written in Unity's frame (metre, Y up, left-handed, facing +Z), whatever the
        /// axes of the context and not mirrored. items: all bones, as vfit_motion_pose gives them;
        /// VFIT_ERROR_DATA where one is missing, or where they have no offsets, as those of vfit_pose_unpack.
        /// bytes null sets *byte_count to what is needed. Does not allocate. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_pose_osc(ContextId context, Pose* pose, Bone* items, uint stride,
            uint count, Osc kind, void* bytes, uint* byteCount);

        /// <summary>A motion as the text of a BVH file: centimetres, Y up, right-handed, whatever the axes of
        /// the context. items: VFIT_BONE_COUNT bones for each pose, as vfit_motion_pose gives them, pose
        /// after pose. The skeleton is that of the last pose, whose lengths are the best known; in the other
        /// poses the hips give way so that the feet stay. BVH has one frame time: frame k shows the motion at
        /// the time of the first pose plus k * frame_time_s (0: 1/30 s), between two poses interpolated.
        /// VFIT_ERROR_DATA where times do not increase. text null sets *capacity to what is needed, the end
        /// included. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_pose_bvh(ContextId context, Pose* poses, uint poseStride,
            uint poseCount, Bone* items, uint stride, uint count, float frameTimeS, byte* text,
            uint* capacity);

        /// <summary>The filtered joints behind the pose, feet corrected. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_motion_joints(MotionId motion, Joint* items, uint stride,
            uint* count);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_shape_list(ContextId context, ShapeValue* items, uint stride,
            uint* count);

        /// <summary>A body of that shape; keys that are not given keep the value of the sex's default body.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_create_from_shape(ContextId context, AvatarDesc* desc,
            ShapeValue* items, uint stride, uint count, AvatarId* @out);

        /// <summary>The default body scaled to stature_m and, where given, shoulder_breadth_m.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_create(ContextId context, AvatarDesc* desc,
            Measurement* items, uint stride, uint count, AvatarId* @out);

        /// <summary>Size and collider radii of the scanned person; by FIT their shape and girths too. [read]
        /// on scan</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_create_from_scan(ContextId context, AvatarDesc* desc,
            ScanId scan, AvatarId* @out);

        /// <summary>Your character as an avatar: bind motion to it, pose it, fetch its buffers. It is turned
        /// to face +Z and stood on the floor; whatever its proportions, the bones of a pose turn it, feet
        /// that motion plants stand, limbs get twist bones, and arms are kept out of its trunk and thighs
        /// (unless desc.flags has LIMBS_AS_POSED). Missing of VRM's optional bones are stood in for. Morph
        /// targets, animations and meshes that hang on no bone are left out and logged. desc.sex and detail
        /// do not apply. Buffers are read from the file's own folder alone, from memory from nowhere else.
        /// VFIT_ERROR_IO; VFIT_ERROR_DATA for a damaged file, one without a humanoid or skin, of no person's
        /// size, or that lies down; VFIT_ERROR_UNSUPPORTED for compressed meshes and sparse data.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_load(ContextId context, AvatarDesc* desc,
            CharacterDesc* character, AvatarId* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_describe(AvatarId avatar, CharacterInfo* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_parts(AvatarId avatar, AvatarPart* items, uint stride,
            uint* count);

        /// <summary>A body and its clothing size for the network, at most 240 bytes: shape, scale, collider
        /// radii, a label of up to 19 bytes (may be null). bytes null sets *byte_count to what is needed. Of
        /// a character from a file: VFIT_ERROR_UNSUPPORTED. The receiver gets the label as TEXT; a packet of
        /// another version of body or library is VFIT_ERROR_VERSION, a damaged one VFIT_ERROR_DATA; desc.sex
        /// is the packet's. [read], [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_pack(AvatarId avatar, byte* sizeLabel, void* bytes,
            uint* byteCount);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_unpack(ContextId context, AvatarDesc* desc, void* bytes,
            uint byteCount, byte* sizeLabel, uint capacity, AvatarId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_destroy(AvatarId avatar);

        /// <summary>Arms go from the last pose to this one around each other and around the trunk, and never
        /// through, where pose.time_ns is later by at most 0.25 s; else they go there at once. Not so with
        /// VFIT_AVATAR_LIMBS_AS_POSED. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_pose(AvatarId avatar, Pose* pose, Bone* items, uint stride,
            uint count);

        /// <summary>The same, the skin written straight into the engine's memory (a mapped vertex buffer),
        /// each vertex as three floats in the context's axes at the target's stride: no copy is made, and
        /// acquire gives the mesh of the last vfit_avatar_pose. Bones, joints, colliders and cloth follow as
        /// with it. normals may be null. Bad targets: VFIT_ERROR_ARGUMENT, UNSUPPORTED or CAPACITY, and
        /// nothing moves. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_pose_into(AvatarId avatar, Pose* pose, Bone* items,
            uint stride, uint count, Target* positions, Target* normals);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_colliders(AvatarId avatar, Collider* items, uint stride,
            uint* count);

        /// <summary>Every joint of the posed avatar, at the avatar's own true place. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_joints(AvatarId avatar, Joint* items, uint stride,
            uint* count);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_rig(AvatarId avatar, RigBone* items, uint stride,
            uint* count);

        /// <summary>Tape measures of the avatar's own body, in the posture of each definition, taken on its
        /// mesh. A character from a file has clothes and no body: VFIT_ERROR_UNSUPPORTED. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_measure(AvatarId avatar, Measurement* items, uint stride,
            uint* count);

        /// <summary>Measures of your own (docs/measuring.md: landmarks, planes and paths as JSON), taken on
        /// the avatar's mesh. sigma is that of the least sure measure of the scan that it was made from,
        /// relative; 0: made of none. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_measure_own(AvatarId avatar, void* text, ulong byteCount,
            Measurement* items, uint stride, uint* count);

        /// <summary>Posed mesh: POSITION, NORMAL, UV, INDEX, BONE_MATRIX, SKIN_BONES, SKIN_WEIGHTS.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_acquire(AvatarId avatar, FrameId* @out);

        /// <summary>The same streams of the unposed mesh that the rig binds to. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_avatar_acquire_rest(AvatarId avatar, FrameId* @out);

        /// <summary>Names of the garments in data_dir/garments, in alphabetical order. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_list(ContextId context, DataName* items, uint stride,
            uint* count);

        /// <summary>A garment as JSON (docs/garments.md), or by the name of a file in data_dir/garments.
        /// [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_load(ContextId context, void* bytes, ulong byteCount,
            GarmentId* @out);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_open(ContextId context, byte* name, GarmentId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_destroy(GarmentId garment);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_describe(GarmentId garment, GarmentInfo* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_garment_parts(GarmentId garment, GarmentPart* items, uint stride,
            uint* count);

        /// <summary>The label of the size at index; length 0 past the last. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint vfit_garment_size_label(GarmentId garment, uint index, byte* buffer,
            uint capacity);

        /// <summary>VFIT_ERROR_NOT_WEARABLE where a labelled size would have to stretch around chest, waist
        /// or hips by more than its fabric takes, or at an opening or over a tenth of it by far more
        /// (docs/garments.md), unless desc.flags has ANY_FIT. [excl] on avatar</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_create(AvatarId avatar, GarmentId garment, ClothDesc* desc,
            ClothId* @out);

        /// <summary>[any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_destroy(ClothId cloth);

        /// <summary>Put on anew: simulated on a body that stands straight, arms held out, and goes into the
        /// pose that the avatar has now, so that limbs push the cloth aside. create carries it into the pose
        /// as it is, at once: right for somebody who stands, not for a stride or a hand at the hip. Takes as
        /// long as some 35 steps (the sundress 0.1 s), whatever the settings. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_reset(ClothId cloth);

        /// <summary>The same garment in another of its sizes (null: made to the avatar), from how it hangs
        /// now: it comes to rest within a second, for which its steps take twice as long. Takes some ten
        /// steps' time. VFIT_ERROR_ARGUMENT where it has no such size, VFIT_ERROR_NOT_WEARABLE as with
        /// create, and nothing changes. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_set_size(ClothId cloth, byte* sizeLabel);

        /// <summary>Sub-steps inside; dt is clamped to 0.1 ms..0.1 s, 0 changes nothing. Reads the avatar:
        /// pose that one first. begin hands the work to a worker and returns, end waits: between the two the
        /// engine renders. To a host's job system such a step is one item. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_step(ClothId cloth, float dt);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_begin_step(ClothId cloth, float dt);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_end_step(ClothId cloth);

        /// <summary>Between steps, for cloth that runs on a slower clock than the picture: acquire then gives
        /// the cloth as the last step left it, carried from that step's pose into the one that the avatar has
        /// now by the bones that carry the garment, at the time of that pose. The next step goes on as if it
        /// had not been called. While a step runs it does not wait: the one before is carried, until
        /// end_step. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_carry(ClothId cloth);

        /// <summary>Makes the next step (of more than 0 s) a jump, however short the way is from the pose of
        /// the last step: a snap turn, a correction over the network. The bones move the cloth as it hangs,
        /// each vertex with those that it is skinned to, and nothing is swept through it. It keeps its
        /// velocity relative to the body. Longer and faster motions are jumps anyway
        /// (vfit_cloth_desc.carry_speed_m_s). Call it for each cloth of an outfit. While a step runs, it
        /// applies to the step after it. vfit_cloth_reset cancels it. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_teleport(ClothId cloth);

        /// <summary>Velocity of the air, in the context's axes and unit a second, from the next step on.
        /// [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_set_wind(ClothId cloth, float* wind);

        /// <summary>Sub-steps a 1/60 s (vfit_cloth_desc), and the time that a step may take: where more would
        /// take longer, fewer are done (at least one), and then a state is no longer the same on each run. 0
        /// sub-steps: 8; 0 ms: no budget. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_set_quality(ClothId cloth, uint substeps, float budgetMs);

        /// <summary>From now on cloth is worn over inner, a cloth of the same avatar: the two push each other
        /// by their mass and do not cross. Within this call cloth goes outside of where the last step of
        /// inner left that, in the pose that the avatar has now; acquire then gives that state, of both.
        /// Takes as long as 6 to 12 steps. Cloths that are worn over each other, through others too, are
        /// simulated as one: the first of them to be stepped in a frame steps all of them, and the steps of
        /// the others, in any order, then find theirs done. So does vfit_cloth_reset, in one pose. Wind's
        /// velocity, quality and budget are of all of them, step_ms and substeps too. Of what their descs
        /// say, all have the largest thickness_m, which is kept between them as well, most substeps and least
        /// inertia; none sleeps where one is AWAKE, and a jump for one is a jump for all; size, the other
        /// flags, friction, self_thickness_m and cover_m stay each one's own; the rest is the outermost's. A
        /// call that is [excl] on one is so on all of them. One that gets destroyed is worn no longer. At
        /// most 64. VFIT_ERROR_NOT_WEARABLE where inner reaches far beyond cloth (a wide skirt below
        /// trousers): both are then carried into the pose, and cloth is not worn over inner.
        /// VFIT_ERROR_ARGUMENT where cloth is worn below inner already, VFIT_ERROR_STATE while a step of
        /// either runs. [excl] on both</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_wear_over(ClothId cloth, ClothId inner);

        /// <summary>Its frame is at the origin until it is moved. VFIT_ERROR_DATA for a mesh without
        /// triangles, with a wrong index, or inside out. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_prop_create(ContextId context, PropDesc* desc, PropId* @out);

        /// <summary>no step that begins later meets it [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_prop_destroy(PropId prop);

        /// <summary>Where its frame is at the end of the next step of each cloth that meets it: call it
        /// before that step begins. While it is called, no other thread may begin such a step
        /// (VFIT_ERROR_BUSY). rotation: xyzw. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_prop_move(PropId prop, float* position, float* rotation);

        /// <summary>The same for the vertices of a MESH, in its own frame: three numbers for each of
        /// vertex_count. [excl]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_prop_deform(PropId prop, float* positions, uint vertexCount);

        /// <summary>From the next step on, cloth meets that prop of its context; and no longer. Each cloth
        /// that shall meet a prop is told so. To add what is there and to remove what is not changes nothing.
        /// At most 64 a cloth. Cost of adding: about ten steps. VFIT_ERROR_STATE while a step runs. [excl] on
        /// cloth, [read] on prop</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_add_prop(ClothId cloth, PropId prop);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_remove_prop(ClothId cloth, PropId prop);

        /// <summary>Skin that this garment alone hides from all who do not look up under it by more than 45
        /// degrees: triangles[i] becomes 1 for those triangles of the avatar's INDEX, and stays what it was
        /// for the others, so that garments add up. Leave them out of what you draw. Found on the body at
        /// rest, of a labelled size as the last step left it there: what is nearer than margin_m to skin that
        /// is seen is left, as cloth slides and hems lift (0: 0.03). VFIT_ERROR_STATE while a step runs.
        /// Takes as long as some 100 steps: once a garment and size. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_hide_skin(ClothId cloth, float marginM, byte* triangles,
            uint count);

        /// <summary>By girths that the garment goes around, of the cloth as it was left by the last step,
        /// less what it sags by: let it come to rest first, best on somebody who stands (docs/garments.md).
        /// Takes as long as some five steps. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_fit(ClothId cloth, FitZone* items, uint stride, uint* count);

        /// <summary>The same place by place, one a vertex of what acquire gives: above 0 tight (1: its
        /// fabric's most strain, or 2 kPa), below 0 loose (-1: 6 cm off the skin). Takes as long as some ten
        /// steps. [read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_fit_map(ClothId cloth, float* values, uint count);

        /// <summary>POSITION, NORMAL, UV, INDEX, STRAIN, and with VFIT_CLOTH_PRESSURE PRESSURE: of a vertex
        /// that touches the body, what its threads and its weight pull with against it, over the flat cloth's
        /// area; 0 where the garment is skinned. Pa whatever the unit. [any]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_acquire(ClothId cloth, FrameId* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_describe(ClothId cloth, ClothStats* @out);

        /// <summary>[read]</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_cloth_state_hash(ClothId cloth, ulong* @out);

        /// <summary>Tests the last finished steps of an outfit, 1 to 64 cloths of one avatar, for triangles
        /// that cross: of each garment with itself, with the skin in the pose of that step, with each later
        /// garment of the list, and with its props as it met them in that step, also those that it let pass.
        /// Every pair of triangles that share no vertex is tested: an empty list proves that none cross. At
        /// most n (n + 3) / 2 items for n cloths, and one for each prop of each: with room for these, one
        /// call is enough. VFIT_ERROR_ARGUMENT where a cloth is listed twice or is of another avatar. While a
        /// step runs, the one before it is tested. Cost: about eight steps of these cloths. [read] on each
        /// cloth</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_outfit_check(ClothId* cloths, uint clothCount, Crossing* items,
            uint stride, uint* count);

        /// <summary>The skin to draw below an outfit, 1 to 64 cloths of one avatar: a frame with the streams
        /// of vfit_avatar_acquire, in the pose in which the first cloth is shown, that of its last finished
        /// step or of the last vfit_cloth_carry since. Where the skin would come through a garment as
        /// vfit_cloth_acquire gives it, it gives way inwards, as flesh does, until no triangles cross. A
        /// patch that would have to give way by more than 2 cm, as that of an arm that goes through the
        /// garment, stays. Normals stay. crossing_pairs (may be null): pairs of a triangle of that skin and
        /// one of a garment that still cross; 0 proves that there are none. VFIT_ERROR_ARGUMENT as with
        /// vfit_outfit_check; VFIT_ERROR_BUSY also where the host holds all frames of the avatar. [excl] on
        /// each cloth and on the avatar; a step may run</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern Result vfit_outfit_skin(ClothId* cloths, uint clothCount, FrameId* @out,
            uint* crossingPairs);
    }
}
