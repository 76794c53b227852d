// Written by scripts/csharp-bindings from include/vfit.h: change that, then run the script.
using System;
using System.Runtime.InteropServices;

namespace Vfit
{
    internal static unsafe class Calls
    {
        internal static uint Version()
        {
            return Native.vfit_version();
        }

        internal static Result LibraryDescribe(LibraryInfo* @out)
        {
            Result result = VfitException.Check(Native.vfit_library_describe(@out));
            return result;
        }

        internal static LibraryInfo LibraryDescribe()
        {
            var value = new LibraryInfo();
            value.StructSize = (uint)sizeof(LibraryInfo);
            LibraryDescribe(&value);
            return value;
        }

        internal static byte* ResultName(Result result)
        {
            return Native.vfit_result_name(result);
        }

        internal static uint LastError(byte* buffer, uint capacity)
        {
            return Native.vfit_last_error(buffer, capacity);
        }

        internal static string LastError()
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = LastError(few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                LastError(bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static Result ContextCreate(ContextDesc* desc, ContextHandle @out)
        {
            var outId = new ContextId();
            Result result = VfitException.Check(Native.vfit_context_create(desc, &outId));
            @out.Put(outId.Value);
            return result;
        }

        internal static Result ContextDestroy(ContextHandle context)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_context_destroy(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld))));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result Shutdown()
        {
            Result result = VfitException.Check(Native.vfit_shutdown());
            return result;
        }

        internal static Result ContextDescribe(ContextHandle context, ContextStats* @out)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_context_describe(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), @out));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static ContextStats ContextDescribe(ContextHandle context)
        {
            var value = new ContextStats();
            value.StructSize = (uint)sizeof(ContextStats);
            ContextDescribe(context, &value);
            return value;
        }

        internal static Result ContextTime(ContextHandle context, long* timeNs)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_context_time(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), timeNs));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result ProfileList(ContextHandle context, Profile* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_profile_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Profile[] ProfileList(ContextHandle context)
        {
            uint listed = 0;
            ProfileList(context, null, (uint)sizeof(Profile), &listed);
            for (;;)
            {
                var list = new Profile[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Profile* first = list) ProfileList(context, first, (uint)sizeof(Profile), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int ProfileList(ContextHandle context, Profile[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Profile none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) ProfileList(context, &none, (uint)sizeof(Profile), &listed);
            else fixed (Profile* first = into) ProfileList(context, first, (uint)sizeof(Profile), &listed);
            return (int)listed;
        }

        internal static Result ProfileReset(ContextHandle context)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_profile_reset(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld))));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result LogNext(ContextHandle context, LogLevel* level, byte* buffer, uint capacity)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_log_next(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), level, buffer, capacity));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PluginLoad(ContextHandle context, byte* path)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_plugin_load(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), path));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PluginList(ContextHandle context, PluginInfo* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_plugin_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static PluginInfo[] PluginList(ContextHandle context)
        {
            uint listed = 0;
            PluginList(context, null, (uint)sizeof(PluginInfo), &listed);
            for (;;)
            {
                var list = new PluginInfo[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (PluginInfo* first = list) PluginList(context, first, (uint)sizeof(PluginInfo),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int PluginList(ContextHandle context, PluginInfo[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            PluginInfo none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) PluginList(context, &none, (uint)sizeof(PluginInfo), &listed);
            else fixed (PluginInfo* first = into) PluginList(context, first, (uint)sizeof(PluginInfo),
                &listed);
            return (int)listed;
        }

        internal static uint JointName(JointId joint, byte* buffer, uint capacity)
        {
            return Native.vfit_joint_name(joint, buffer, capacity);
        }

        internal static string JointName(JointId joint)
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = JointName(joint, few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                JointName(joint, bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static uint BoneName(BoneId bone, byte* buffer, uint capacity)
        {
            return Native.vfit_bone_name(bone, buffer, capacity);
        }

        internal static string BoneName(BoneId bone)
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = BoneName(bone, few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                BoneName(bone, bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static int BoneParent(BoneId bone)
        {
            return Native.vfit_bone_parent(bone);
        }

        internal static uint MeasureKey(uint index, byte* buffer, uint capacity)
        {
            return Native.vfit_measure_key(index, buffer, capacity);
        }

        internal static string MeasureKey(uint index)
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = MeasureKey(index, few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                MeasureKey(index, bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static uint MeasureText(uint index, byte* buffer, uint capacity)
        {
            return Native.vfit_measure_text(index, buffer, capacity);
        }

        internal static string MeasureText(uint index)
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = MeasureText(index, few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                MeasureText(index, bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static Result FrameCreate(ContextHandle context, FrameDesc* desc, FrameHandle @out)
        {
            bool contextHeld = false;
            var outId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result FrameRetain(FrameHandle frame)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_retain(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld))));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result FrameRelease(FrameHandle frame)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_release(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld))));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result FrameStreams(FrameHandle frame, StreamKind* items, uint* count)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_streams(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), items, count));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static StreamKind[] FrameStreams(FrameHandle frame)
        {
            uint listed = 0;
            FrameStreams(frame, null, &listed);
            for (;;)
            {
                var list = new StreamKind[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (StreamKind* first = list) FrameStreams(frame, first, &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int FrameStreams(FrameHandle frame, StreamKind[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            StreamKind none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) FrameStreams(frame, &none, &listed);
            else fixed (StreamKind* first = into) FrameStreams(frame, first, &listed);
            return (int)listed;
        }

        internal static Result FrameView(FrameHandle frame, StreamKind stream, View* @out)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_view(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), stream, @out));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static View FrameView(FrameHandle frame, StreamKind stream)
        {
            var value = new View();
            value.StructSize = (uint)sizeof(View);
            FrameView(frame, stream, &value);
            return value;
        }

        internal static Result FrameIntrinsics(FrameHandle frame, Intrinsics* @out)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_intrinsics(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), @out));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Intrinsics FrameIntrinsics(FrameHandle frame)
        {
            var value = new Intrinsics();
            value.StructSize = (uint)sizeof(Intrinsics);
            FrameIntrinsics(frame, &value);
            return value;
        }

        internal static Result FrameCamera(FrameHandle frame, Camera* @out)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_camera(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), @out));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Camera FrameCamera(FrameHandle frame)
        {
            var value = new Camera();
            value.StructSize = (uint)sizeof(Camera);
            FrameCamera(frame, &value);
            return value;
        }

        internal static Result FrameMeta(FrameHandle frame, byte* key, byte* buffer, uint capacity,
            uint* length)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_meta(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), key, buffer, capacity, length));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result FrameWrite(FrameHandle frame, StreamKind stream, Target* target, ulong* serial)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_write(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), stream, target, serial));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result SensorList(ContextHandle context, SensorInfo* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static SensorInfo[] SensorList(ContextHandle context)
        {
            uint listed = 0;
            SensorList(context, null, (uint)sizeof(SensorInfo), &listed);
            for (;;)
            {
                var list = new SensorInfo[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (SensorInfo* first = list) SensorList(context, first, (uint)sizeof(SensorInfo),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SensorList(ContextHandle context, SensorInfo[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            SensorInfo none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SensorList(context, &none, (uint)sizeof(SensorInfo), &listed);
            else fixed (SensorInfo* first = into) SensorList(context, first, (uint)sizeof(SensorInfo),
                &listed);
            return (int)listed;
        }

        internal static Result SensorChanges(ContextHandle context, ulong* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_changes(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result SensorOpen(ContextHandle context, byte* uri, SensorHandle @out)
        {
            bool contextHeld = false;
            var outId = new SensorId();
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_open(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), uri, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result SensorModes(SensorHandle sensor, SensorMode* items, uint stride, uint* count)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_modes(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static SensorMode[] SensorModes(SensorHandle sensor)
        {
            uint listed = 0;
            SensorModes(sensor, null, (uint)sizeof(SensorMode), &listed);
            for (;;)
            {
                var list = new SensorMode[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (SensorMode* first = list) SensorModes(sensor, first, (uint)sizeof(SensorMode),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SensorModes(SensorHandle sensor, SensorMode[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            SensorMode none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SensorModes(sensor, &none, (uint)sizeof(SensorMode), &listed);
            else fixed (SensorMode* first = into) SensorModes(sensor, first, (uint)sizeof(SensorMode),
                &listed);
            return (int)listed;
        }

        internal static Result SensorOptions(SensorHandle sensor, SensorOption* items, uint stride,
            uint* count)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_options(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static SensorOption[] SensorOptions(SensorHandle sensor)
        {
            uint listed = 0;
            SensorOptions(sensor, null, (uint)sizeof(SensorOption), &listed);
            for (;;)
            {
                var list = new SensorOption[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (SensorOption* first = list) SensorOptions(sensor, first,
                        (uint)sizeof(SensorOption), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SensorOptions(SensorHandle sensor, SensorOption[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            SensorOption none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SensorOptions(sensor, &none, (uint)sizeof(SensorOption), &listed);
            else fixed (SensorOption* first = into) SensorOptions(sensor, first, (uint)sizeof(SensorOption),
                &listed);
            return (int)listed;
        }

        internal static Result SensorSetOption(SensorHandle sensor, byte* key, byte* value)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_set_option(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld)), key, value));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static Result SensorStart(SensorHandle sensor)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_start(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld))));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static Result SensorStop(SensorHandle sensor)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_stop(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld))));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static Result SensorClose(SensorHandle sensor)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_close(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld))));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static Result SensorAcquire(SensorHandle sensor, long timeoutNs, FrameHandle @out)
        {
            bool sensorHeld = false;
            var outId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_acquire(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld)), timeoutNs, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static Result SensorDescribe(SensorHandle sensor, SensorStats* @out)
        {
            bool sensorHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_sensor_describe(
                    new SensorId(VfitHandle.Hold(sensor, ref sensorHeld)), @out));
                return result;
            }
            finally
            {
                if (sensorHeld) sensor.DangerousRelease();
            }
        }

        internal static SensorStats SensorDescribe(SensorHandle sensor)
        {
            var value = new SensorStats();
            value.StructSize = (uint)sizeof(SensorStats);
            SensorDescribe(sensor, &value);
            return value;
        }

        internal static Result RecorderCreate(ContextHandle context, byte* path, RecorderDesc* desc,
            RecorderHandle @out)
        {
            bool contextHeld = false;
            var outId = new RecorderId();
            try
            {
                Result result = VfitException.Check(Native.vfit_recorder_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), path, desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result RecorderWrite(RecorderHandle recorder, FrameHandle frame)
        {
            bool recorderHeld = false;
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_recorder_write(
                    new RecorderId(VfitHandle.Hold(recorder, ref recorderHeld)),
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld))));
                return result;
            }
            finally
            {
                if (recorderHeld) recorder.DangerousRelease();
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result RecorderDestroy(RecorderHandle recorder)
        {
            bool recorderHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_recorder_destroy(
                    new RecorderId(VfitHandle.Hold(recorder, ref recorderHeld))));
                return result;
            }
            finally
            {
                if (recorderHeld) recorder.DangerousRelease();
            }
        }

        internal static Result FrameBodies(FrameHandle frame, Body* items, uint stride, uint* count)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_bodies(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Body[] FrameBodies(FrameHandle frame)
        {
            uint listed = 0;
            FrameBodies(frame, null, (uint)sizeof(Body), &listed);
            for (;;)
            {
                var list = new Body[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Body* first = list) FrameBodies(frame, first, (uint)sizeof(Body), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int FrameBodies(FrameHandle frame, Body[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Body none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) FrameBodies(frame, &none, (uint)sizeof(Body), &listed);
            else fixed (Body* first = into) FrameBodies(frame, first, (uint)sizeof(Body), &listed);
            return (int)listed;
        }

        internal static Result FrameJoints(FrameHandle frame, uint bodyId, Joint* items, uint stride,
            uint* count)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_joints(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), bodyId, items, stride, count));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Joint[] FrameJoints(FrameHandle frame, uint bodyId)
        {
            uint listed = 0;
            FrameJoints(frame, bodyId, null, (uint)sizeof(Joint), &listed);
            for (;;)
            {
                var list = new Joint[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Joint* first = list) FrameJoints(frame, bodyId, first, (uint)sizeof(Joint),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int FrameJoints(FrameHandle frame, uint bodyId, Joint[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Joint none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) FrameJoints(frame, bodyId, &none, (uint)sizeof(Joint), &listed);
            else fixed (Joint* first = into) FrameJoints(frame, bodyId, first, (uint)sizeof(Joint), &listed);
            return (int)listed;
        }

        internal static Result TrackerCreate(ContextHandle context, TrackerDesc* desc, TrackerHandle @out)
        {
            bool contextHeld = false;
            var outId = new TrackerId();
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result TrackerDestroy(TrackerHandle tracker)
        {
            bool trackerHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_destroy(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld))));
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
            }
        }

        internal static Result TrackerUpdate(TrackerHandle tracker, FrameHandle frame, FrameHandle tracked)
        {
            bool trackerHeld = false;
            bool frameHeld = false;
            var trackedId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_update(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld)),
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), &trackedId));
                tracked.Put(trackedId.Value);
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result TrackerSubmit(TrackerHandle tracker, FrameHandle frame, Body* body,
            Joint* items, uint stride, uint count, FrameHandle tracked)
        {
            bool trackerHeld = false;
            bool frameHeld = false;
            var trackedId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_submit(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld)),
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), body, items, stride, count,
                    &trackedId));
                tracked.Put(trackedId.Value);
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result TrackerHint(TrackerHandle tracker, JointHint* items, uint stride, uint count)
        {
            bool trackerHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_hint(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
            }
        }

        internal static Result TrackerHintFrom(TrackerHandle tracker, FrameHandle seen, uint bodyId,
            float* position, float* rotation)
        {
            bool trackerHeld = false;
            bool seenHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_hint_from(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld)),
                    new FrameId(VfitHandle.Hold(seen, ref seenHeld)), bodyId, position, rotation));
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
                if (seenHeld) seen.DangerousRelease();
            }
        }

        internal static Result WorldAlign(ContextHandle context, float* here, float* there, uint count,
            float* position, float* rotation, float* rms)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_world_align(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), here, there, count, position,
                    rotation, rms));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result TrackerReset(TrackerHandle tracker)
        {
            bool trackerHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_reset(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld))));
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
            }
        }

        internal static Result TrackerSetActive(TrackerHandle tracker, uint bodyId)
        {
            bool trackerHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_tracker_set_active(
                    new TrackerId(VfitHandle.Hold(tracker, ref trackerHeld)), bodyId));
                return result;
            }
            finally
            {
                if (trackerHeld) tracker.DangerousRelease();
            }
        }

        internal static Result FrameActiveBody(FrameHandle frame, uint* bodyId, ActiveState* state)
        {
            bool frameHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_frame_active_body(
                    new FrameId(VfitHandle.Hold(frame, ref frameHeld)), bodyId, state));
                return result;
            }
            finally
            {
                if (frameHeld) frame.DangerousRelease();
            }
        }

        internal static Result ScanCreate(ContextHandle context, ScanDesc* desc, ScanHandle @out)
        {
            bool contextHeld = false;
            var outId = new ScanId();
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result ScanDestroy(ScanHandle scan)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_destroy(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld))));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Result ScanReset(ScanHandle scan)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_reset(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld))));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Result ScanExtend(ScanHandle scan, uint frames, uint sideFrames)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_extend(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), frames, sideFrames));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Result ScanAdd(ScanHandle scan, FrameHandle tracked, uint bodyId, ScanState* state)
        {
            bool scanHeld = false;
            bool trackedHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_add(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), new FrameId(VfitHandle.Hold(tracked,
                    ref trackedHeld)), bodyId, state));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
                if (trackedHeld) tracked.DangerousRelease();
            }
        }

        internal static Result ScanAddFrom(ScanHandle scan, uint camera, FrameHandle tracked, uint bodyId,
            ScanState* state)
        {
            bool scanHeld = false;
            bool trackedHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_add_from(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), camera,
                    new FrameId(VfitHandle.Hold(tracked, ref trackedHeld)), bodyId, state));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
                if (trackedHeld) tracked.DangerousRelease();
            }
        }

        internal static Result ScanMeasure(ScanHandle scan, Measurement* items, uint stride, uint* count)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_measure(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Measurement[] ScanMeasure(ScanHandle scan)
        {
            uint listed = 0;
            ScanMeasure(scan, null, (uint)sizeof(Measurement), &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) ScanMeasure(scan, first, (uint)sizeof(Measurement),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int ScanMeasure(ScanHandle scan, Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) ScanMeasure(scan, &none, (uint)sizeof(Measurement), &listed);
            else fixed (Measurement* first = into) ScanMeasure(scan, first, (uint)sizeof(Measurement),
                &listed);
            return (int)listed;
        }

        internal static Result ScanSex(ScanHandle scan, Sex* sex, float* probability)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_sex(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), sex, probability));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Result ScanColliders(ScanHandle scan, Collider* items, uint stride, uint* count)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_colliders(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Collider[] ScanColliders(ScanHandle scan)
        {
            uint listed = 0;
            ScanColliders(scan, null, (uint)sizeof(Collider), &listed);
            for (;;)
            {
                var list = new Collider[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Collider* first = list) ScanColliders(scan, first, (uint)sizeof(Collider),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int ScanColliders(ScanHandle scan, Collider[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Collider none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) ScanColliders(scan, &none, (uint)sizeof(Collider), &listed);
            else fixed (Collider* first = into) ScanColliders(scan, first, (uint)sizeof(Collider), &listed);
            return (int)listed;
        }

        internal static Result ScanScale(ScanHandle scan, byte* garmentKind, Scale* @out)
        {
            bool scanHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_scan_scale(
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), garmentKind, @out));
                return result;
            }
            finally
            {
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Scale ScanScale(ScanHandle scan, byte* garmentKind)
        {
            var value = new Scale();
            value.StructSize = (uint)sizeof(Scale);
            ScanScale(scan, garmentKind, &value);
            return value;
        }

        internal static Result MeasurementsWrite(Measurement* items, uint stride, uint count, Sex sex,
            byte* text, uint* capacity)
        {
            Result result = VfitException.Check(Native.vfit_measurements_write(
                items, stride, count, sex, text, capacity));
            return result;
        }

        internal static Result MeasurementsRead(void* text, ulong byteCount, Measurement* items, uint stride,
            uint* count, Sex* sex)
        {
            Result result = VfitException.Check(Native.vfit_measurements_read(
                text, byteCount, items, stride, count, sex));
            return result;
        }

        internal static Result MeasurementsMerge(Measurement* a, uint aStride, uint aCount, Measurement* b,
            uint bStride, uint bCount, Measurement* items, uint stride, uint* count)
        {
            Result result = VfitException.Check(Native.vfit_measurements_merge(
                a, aStride, aCount, b, bStride, bCount, items, stride, count));
            return result;
        }

        internal static Measurement[] MeasurementsMerge(Measurement* a, uint aStride, uint aCount,
            Measurement* b, uint bStride, uint bCount)
        {
            uint listed = 0;
            MeasurementsMerge(a, aStride, aCount, b, bStride, bCount, null, (uint)sizeof(Measurement),
                &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) MeasurementsMerge(a, aStride, aCount, b, bStride,
                        bCount, first, (uint)sizeof(Measurement), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int MeasurementsMerge(Measurement* a, uint aStride, uint aCount, Measurement* b,
            uint bStride, uint bCount, Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) MeasurementsMerge(a, aStride, aCount, b, bStride, bCount, &none,
                (uint)sizeof(Measurement), &listed);
            else fixed (Measurement* first = into) MeasurementsMerge(a, aStride, aCount, b, bStride, bCount,
                first, (uint)sizeof(Measurement), &listed);
            return (int)listed;
        }

        internal static Result CalibrationAdd(void* text, ulong byteCount, Measurement* scanned,
            uint scannedStride, uint scannedCount, Measurement* taped, uint tapedStride, uint tapedCount,
            byte* @out, uint* capacity)
        {
            Result result = VfitException.Check(Native.vfit_calibration_add(
                text, byteCount, scanned, scannedStride, scannedCount, taped, tapedStride, tapedCount, @out,
                capacity));
            return result;
        }

        internal static Result CalibrationMeasures(void* text, ulong byteCount, CalibratedMeasure* items,
            uint stride, uint* count)
        {
            Result result = VfitException.Check(Native.vfit_calibration_measures(
                text, byteCount, items, stride, count));
            return result;
        }

        internal static CalibratedMeasure[] CalibrationMeasures(void* text, ulong byteCount)
        {
            uint listed = 0;
            CalibrationMeasures(text, byteCount, null, (uint)sizeof(CalibratedMeasure), &listed);
            for (;;)
            {
                var list = new CalibratedMeasure[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (CalibratedMeasure* first = list) CalibrationMeasures(text, byteCount, first,
                        (uint)sizeof(CalibratedMeasure), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int CalibrationMeasures(void* text, ulong byteCount, CalibratedMeasure[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            CalibratedMeasure none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) CalibrationMeasures(text, byteCount, &none, (uint)sizeof(CalibratedMeasure),
                &listed);
            else fixed (CalibratedMeasure* first = into) CalibrationMeasures(text, byteCount, first,
                (uint)sizeof(CalibratedMeasure), &listed);
            return (int)listed;
        }

        internal static Result CalibrationApply(void* text, ulong byteCount, Measurement* scanned,
            uint scannedStride, uint scannedCount, Measurement* items, uint stride, uint* count)
        {
            Result result = VfitException.Check(Native.vfit_calibration_apply(
                text, byteCount, scanned, scannedStride, scannedCount, items, stride, count));
            return result;
        }

        internal static Measurement[] CalibrationApply(void* text, ulong byteCount, Measurement* scanned,
            uint scannedStride, uint scannedCount)
        {
            uint listed = 0;
            CalibrationApply(text, byteCount, scanned, scannedStride, scannedCount, null,
                (uint)sizeof(Measurement), &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) CalibrationApply(text, byteCount, scanned,
                        scannedStride, scannedCount, first, (uint)sizeof(Measurement), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int CalibrationApply(void* text, ulong byteCount, Measurement* scanned,
            uint scannedStride, uint scannedCount, Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) CalibrationApply(text, byteCount, scanned, scannedStride, scannedCount, &none,
                (uint)sizeof(Measurement), &listed);
            else fixed (Measurement* first = into) CalibrationApply(text, byteCount, scanned, scannedStride,
                scannedCount, first, (uint)sizeof(Measurement), &listed);
            return (int)listed;
        }

        internal static Result PopulationList(ContextHandle context, DataName* items, uint stride,
            uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_population_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static DataName[] PopulationList(ContextHandle context)
        {
            uint listed = 0;
            PopulationList(context, null, (uint)sizeof(DataName), &listed);
            for (;;)
            {
                var list = new DataName[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (DataName* first = list) PopulationList(context, first, (uint)sizeof(DataName),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int PopulationList(ContextHandle context, DataName[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            DataName none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) PopulationList(context, &none, (uint)sizeof(DataName), &listed);
            else fixed (DataName* first = into) PopulationList(context, first, (uint)sizeof(DataName),
                &listed);
            return (int)listed;
        }

        internal static Result PopulationLoad(ContextHandle context, void* bytes, ulong byteCount,
            PopulationHandle @out)
        {
            bool contextHeld = false;
            var outId = new PopulationId();
            try
            {
                Result result = VfitException.Check(Native.vfit_population_load(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), bytes, byteCount, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PopulationOpen(ContextHandle context, byte* name, PopulationHandle @out)
        {
            bool contextHeld = false;
            var outId = new PopulationId();
            try
            {
                Result result = VfitException.Check(Native.vfit_population_open(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), name, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PopulationDestroy(PopulationHandle population)
        {
            bool populationHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_population_destroy(
                    new PopulationId(VfitHandle.Hold(population, ref populationHeld))));
                return result;
            }
            finally
            {
                if (populationHeld) population.DangerousRelease();
            }
        }

        internal static Result PopulationEstimate(PopulationHandle population, Person* person,
            Measurement* known, uint knownStride, uint knownCount, Measurement* items, uint stride,
            uint* count)
        {
            bool populationHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_population_estimate(
                    new PopulationId(VfitHandle.Hold(population, ref populationHeld)), person, known,
                    knownStride, knownCount, items, stride, count));
                return result;
            }
            finally
            {
                if (populationHeld) population.DangerousRelease();
            }
        }

        internal static Measurement[] PopulationEstimate(PopulationHandle population, Person* person,
            Measurement* known, uint knownStride, uint knownCount)
        {
            uint listed = 0;
            PopulationEstimate(population, person, known, knownStride, knownCount, null,
                (uint)sizeof(Measurement), &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) PopulationEstimate(population, person, known,
                        knownStride, knownCount, first, (uint)sizeof(Measurement), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int PopulationEstimate(PopulationHandle population, Person* person,
            Measurement* known, uint knownStride, uint knownCount, Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) PopulationEstimate(population, person, known, knownStride, knownCount, &none,
                (uint)sizeof(Measurement), &listed);
            else fixed (Measurement* first = into) PopulationEstimate(population, person, known, knownStride,
                knownCount, first, (uint)sizeof(Measurement), &listed);
            return (int)listed;
        }

        internal static Result PopulationCheck(PopulationHandle population, Person* person,
            Measurement* known, uint knownStride, uint knownCount, Doubt* items, uint stride, uint* count)
        {
            bool populationHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_population_check(
                    new PopulationId(VfitHandle.Hold(population, ref populationHeld)), person, known,
                    knownStride, knownCount, items, stride, count));
                return result;
            }
            finally
            {
                if (populationHeld) population.DangerousRelease();
            }
        }

        internal static Doubt[] PopulationCheck(PopulationHandle population, Person* person,
            Measurement* known, uint knownStride, uint knownCount)
        {
            uint listed = 0;
            PopulationCheck(population, person, known, knownStride, knownCount, null, (uint)sizeof(Doubt),
                &listed);
            for (;;)
            {
                var list = new Doubt[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Doubt* first = list) PopulationCheck(population, person, known, knownStride,
                        knownCount, first, (uint)sizeof(Doubt), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int PopulationCheck(PopulationHandle population, Person* person, Measurement* known,
            uint knownStride, uint knownCount, Doubt[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Doubt none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) PopulationCheck(population, person, known, knownStride, knownCount, &none,
                (uint)sizeof(Doubt), &listed);
            else fixed (Doubt* first = into) PopulationCheck(population, person, known, knownStride,
                knownCount, first, (uint)sizeof(Doubt), &listed);
            return (int)listed;
        }

        internal static Result SizeChartList(ContextHandle context, DataName* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_size_chart_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static DataName[] SizeChartList(ContextHandle context)
        {
            uint listed = 0;
            SizeChartList(context, null, (uint)sizeof(DataName), &listed);
            for (;;)
            {
                var list = new DataName[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (DataName* first = list) SizeChartList(context, first, (uint)sizeof(DataName),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SizeChartList(ContextHandle context, DataName[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            DataName none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SizeChartList(context, &none, (uint)sizeof(DataName), &listed);
            else fixed (DataName* first = into) SizeChartList(context, first, (uint)sizeof(DataName),
                &listed);
            return (int)listed;
        }

        internal static Result SizeChartLoad(ContextHandle context, void* bytes, ulong byteCount,
            SizeChartHandle @out)
        {
            bool contextHeld = false;
            var outId = new SizeChartId();
            try
            {
                Result result = VfitException.Check(Native.vfit_size_chart_load(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), bytes, byteCount, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result SizeChartOpen(ContextHandle context, byte* name, SizeChartHandle @out)
        {
            bool contextHeld = false;
            var outId = new SizeChartId();
            try
            {
                Result result = VfitException.Check(Native.vfit_size_chart_open(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), name, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result SizeChartDestroy(SizeChartHandle chart)
        {
            bool chartHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_size_chart_destroy(
                    new SizeChartId(VfitHandle.Hold(chart, ref chartHeld))));
                return result;
            }
            finally
            {
                if (chartHeld) chart.DangerousRelease();
            }
        }

        internal static Result SizeChartRows(SizeChartHandle chart, SizeRow* items, uint stride, uint* count)
        {
            bool chartHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_size_chart_rows(
                    new SizeChartId(VfitHandle.Hold(chart, ref chartHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (chartHeld) chart.DangerousRelease();
            }
        }

        internal static SizeRow[] SizeChartRows(SizeChartHandle chart)
        {
            uint listed = 0;
            SizeChartRows(chart, null, (uint)sizeof(SizeRow), &listed);
            for (;;)
            {
                var list = new SizeRow[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (SizeRow* first = list) SizeChartRows(chart, first, (uint)sizeof(SizeRow), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SizeChartRows(SizeChartHandle chart, SizeRow[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            SizeRow none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SizeChartRows(chart, &none, (uint)sizeof(SizeRow), &listed);
            else fixed (SizeRow* first = into) SizeChartRows(chart, first, (uint)sizeof(SizeRow), &listed);
            return (int)listed;
        }

        internal static Result SizeRecommend(SizeChartHandle chart, byte* garmentKind, Measurement* items,
            uint stride, uint count, Size* sizes, uint sizeStride, uint* sizeCount)
        {
            bool chartHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_size_recommend(
                    new SizeChartId(VfitHandle.Hold(chart, ref chartHeld)), garmentKind, items, stride,
                    count, sizes, sizeStride, sizeCount));
                return result;
            }
            finally
            {
                if (chartHeld) chart.DangerousRelease();
            }
        }

        internal static Size[] SizeRecommend(SizeChartHandle chart, byte* garmentKind, Measurement* items,
            uint stride, uint count)
        {
            uint listed = 0;
            SizeRecommend(chart, garmentKind, items, stride, count, null, (uint)sizeof(Size), &listed);
            for (;;)
            {
                var list = new Size[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Size* first = list) SizeRecommend(chart, garmentKind, items, stride, count, first,
                        (uint)sizeof(Size), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SizeRecommend(SizeChartHandle chart, byte* garmentKind, Measurement* items,
            uint stride, uint count, Size[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Size none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SizeRecommend(chart, garmentKind, items, stride, count, &none,
                (uint)sizeof(Size), &listed);
            else fixed (Size* first = into) SizeRecommend(chart, garmentKind, items, stride, count, first,
                (uint)sizeof(Size), &listed);
            return (int)listed;
        }

        internal static Result SizeZones(SizeChartHandle chart, byte* garmentKind, byte* label,
            Measurement* items, uint stride, uint count, SizeZone* zones, uint zoneStride, uint* zoneCount)
        {
            bool chartHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_size_zones(
                    new SizeChartId(VfitHandle.Hold(chart, ref chartHeld)), garmentKind, label, items,
                    stride, count, zones, zoneStride, zoneCount));
                return result;
            }
            finally
            {
                if (chartHeld) chart.DangerousRelease();
            }
        }

        internal static SizeZone[] SizeZones(SizeChartHandle chart, byte* garmentKind, byte* label,
            Measurement* items, uint stride, uint count)
        {
            uint listed = 0;
            SizeZones(chart, garmentKind, label, items, stride, count, null, (uint)sizeof(SizeZone), &listed);
            for (;;)
            {
                var list = new SizeZone[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (SizeZone* first = list) SizeZones(chart, garmentKind, label, items, stride, count,
                        first, (uint)sizeof(SizeZone), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int SizeZones(SizeChartHandle chart, byte* garmentKind, byte* label,
            Measurement* items, uint stride, uint count, SizeZone[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            SizeZone none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) SizeZones(chart, garmentKind, label, items, stride, count, &none,
                (uint)sizeof(SizeZone), &listed);
            else fixed (SizeZone* first = into) SizeZones(chart, garmentKind, label, items, stride, count,
                first, (uint)sizeof(SizeZone), &listed);
            return (int)listed;
        }

        internal static Result MotionCreate(ContextHandle context, MotionDesc* desc, MotionHandle @out)
        {
            bool contextHeld = false;
            var outId = new MotionId();
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result MotionDestroy(MotionHandle motion)
        {
            bool motionHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_destroy(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld))));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
            }
        }

        internal static Result MotionReset(MotionHandle motion)
        {
            bool motionHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_reset(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld))));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
            }
        }

        internal static Result MotionBind(MotionHandle motion, AvatarHandle avatar)
        {
            bool motionHeld = false;
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_bind(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld)),
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld))));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result MotionStep(MotionHandle motion, FrameHandle tracked, uint bodyId, long nowNs)
        {
            bool motionHeld = false;
            bool trackedHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_step(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld)),
                    new FrameId(VfitHandle.Hold(tracked, ref trackedHeld)), bodyId, nowNs));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
                if (trackedHeld) tracked.DangerousRelease();
            }
        }

        internal static Result MotionStepBody(MotionHandle motion, Body* body, Joint* items, uint stride,
            uint count, long nowNs)
        {
            bool motionHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_step_body(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld)), body, items, stride, count,
                    nowNs));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
            }
        }

        internal static Result MotionPose(MotionHandle motion, Pose* pose, Bone* items, uint stride,
            uint* count)
        {
            bool motionHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_pose(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld)), pose, items, stride, count));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
            }
        }

        internal static Bone[] MotionPose(MotionHandle motion, Pose* pose)
        {
            uint listed = 0;
            MotionPose(motion, pose, null, (uint)sizeof(Bone), &listed);
            for (;;)
            {
                var list = new Bone[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Bone* first = list) MotionPose(motion, pose, first, (uint)sizeof(Bone), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int MotionPose(MotionHandle motion, Pose* pose, Bone[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Bone none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) MotionPose(motion, pose, &none, (uint)sizeof(Bone), &listed);
            else fixed (Bone* first = into) MotionPose(motion, pose, first, (uint)sizeof(Bone), &listed);
            return (int)listed;
        }

        internal static Result PosePack(ContextHandle context, Pose* pose, Bone* items, uint stride,
            uint count, void* bytes, uint* byteCount)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_pose_pack(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), pose, items, stride, count,
                    bytes, byteCount));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PoseUnpack(ContextHandle context, void* bytes, uint byteCount, Pose* pose,
            Bone* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_pose_unpack(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), bytes, byteCount, pose, items,
                    stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Bone[] PoseUnpack(ContextHandle context, void* bytes, uint byteCount, Pose* pose)
        {
            uint listed = 0;
            PoseUnpack(context, bytes, byteCount, pose, null, (uint)sizeof(Bone), &listed);
            for (;;)
            {
                var list = new Bone[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Bone* first = list) PoseUnpack(context, bytes, byteCount, pose, first,
                        (uint)sizeof(Bone), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int PoseUnpack(ContextHandle context, void* bytes, uint byteCount, Pose* pose,
            Bone[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Bone none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) PoseUnpack(context, bytes, byteCount, pose, &none, (uint)sizeof(Bone), &listed);
            else fixed (Bone* first = into) PoseUnpack(context, bytes, byteCount, pose, first,
                (uint)sizeof(Bone), &listed);
            return (int)listed;
        }

        internal static Result PoseOsc(ContextHandle context, Pose* pose, Bone* items, uint stride,
            uint count, Osc kind, void* bytes, uint* byteCount)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_pose_osc(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), pose, items, stride, count,
                    kind, bytes, byteCount));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PoseBvh(ContextHandle context, Pose* poses, uint poseStride, uint poseCount,
            Bone* items, uint stride, uint count, float frameTimeS, byte* text, uint* capacity)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_pose_bvh(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), poses, poseStride, poseCount,
                    items, stride, count, frameTimeS, text, capacity));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result MotionJoints(MotionHandle motion, Joint* items, uint stride, uint* count)
        {
            bool motionHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_motion_joints(
                    new MotionId(VfitHandle.Hold(motion, ref motionHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (motionHeld) motion.DangerousRelease();
            }
        }

        internal static Joint[] MotionJoints(MotionHandle motion)
        {
            uint listed = 0;
            MotionJoints(motion, null, (uint)sizeof(Joint), &listed);
            for (;;)
            {
                var list = new Joint[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Joint* first = list) MotionJoints(motion, first, (uint)sizeof(Joint), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int MotionJoints(MotionHandle motion, Joint[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Joint none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) MotionJoints(motion, &none, (uint)sizeof(Joint), &listed);
            else fixed (Joint* first = into) MotionJoints(motion, first, (uint)sizeof(Joint), &listed);
            return (int)listed;
        }

        internal static Result ShapeList(ContextHandle context, ShapeValue* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_shape_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static ShapeValue[] ShapeList(ContextHandle context)
        {
            uint listed = 0;
            ShapeList(context, null, (uint)sizeof(ShapeValue), &listed);
            for (;;)
            {
                var list = new ShapeValue[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (ShapeValue* first = list) ShapeList(context, first, (uint)sizeof(ShapeValue),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int ShapeList(ContextHandle context, ShapeValue[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            ShapeValue none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) ShapeList(context, &none, (uint)sizeof(ShapeValue), &listed);
            else fixed (ShapeValue* first = into) ShapeList(context, first, (uint)sizeof(ShapeValue),
                &listed);
            return (int)listed;
        }

        internal static Result AvatarCreateFromShape(ContextHandle context, AvatarDesc* desc,
            ShapeValue* items, uint stride, uint count, AvatarHandle @out)
        {
            bool contextHeld = false;
            var outId = new AvatarId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_create_from_shape(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, items, stride, count,
                    &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result AvatarCreate(ContextHandle context, AvatarDesc* desc, Measurement* items,
            uint stride, uint count, AvatarHandle @out)
        {
            bool contextHeld = false;
            var outId = new AvatarId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, items, stride, count,
                    &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result AvatarCreateFromScan(ContextHandle context, AvatarDesc* desc, ScanHandle scan,
            AvatarHandle @out)
        {
            bool contextHeld = false;
            bool scanHeld = false;
            var outId = new AvatarId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_create_from_scan(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc,
                    new ScanId(VfitHandle.Hold(scan, ref scanHeld)), &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
                if (scanHeld) scan.DangerousRelease();
            }
        }

        internal static Result AvatarLoad(ContextHandle context, AvatarDesc* desc, CharacterDesc* character,
            AvatarHandle @out)
        {
            bool contextHeld = false;
            var outId = new AvatarId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_load(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, character, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result AvatarDescribe(AvatarHandle avatar, CharacterInfo* @out)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_describe(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), @out));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static CharacterInfo AvatarDescribe(AvatarHandle avatar)
        {
            var value = new CharacterInfo();
            value.StructSize = (uint)sizeof(CharacterInfo);
            AvatarDescribe(avatar, &value);
            return value;
        }

        internal static Result AvatarParts(AvatarHandle avatar, AvatarPart* items, uint stride, uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_parts(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static AvatarPart[] AvatarParts(AvatarHandle avatar)
        {
            uint listed = 0;
            AvatarParts(avatar, null, (uint)sizeof(AvatarPart), &listed);
            for (;;)
            {
                var list = new AvatarPart[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (AvatarPart* first = list) AvatarParts(avatar, first, (uint)sizeof(AvatarPart),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarParts(AvatarHandle avatar, AvatarPart[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            AvatarPart none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarParts(avatar, &none, (uint)sizeof(AvatarPart), &listed);
            else fixed (AvatarPart* first = into) AvatarParts(avatar, first, (uint)sizeof(AvatarPart),
                &listed);
            return (int)listed;
        }

        internal static Result AvatarPack(AvatarHandle avatar, byte* sizeLabel, void* bytes, uint* byteCount)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_pack(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), sizeLabel, bytes, byteCount));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result AvatarUnpack(ContextHandle context, AvatarDesc* desc, void* bytes,
            uint byteCount, byte* sizeLabel, uint capacity, AvatarHandle @out)
        {
            bool contextHeld = false;
            var outId = new AvatarId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_unpack(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, bytes, byteCount,
                    sizeLabel, capacity, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result AvatarDestroy(AvatarHandle avatar)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_destroy(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld))));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result AvatarPose(AvatarHandle avatar, Pose* pose, Bone* items, uint stride,
            uint count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_pose(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), pose, items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result AvatarPoseInto(AvatarHandle avatar, Pose* pose, Bone* items, uint stride,
            uint count, Target* positions, Target* normals)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_pose_into(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), pose, items, stride, count,
                    positions, normals));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result AvatarColliders(AvatarHandle avatar, Collider* items, uint stride, uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_colliders(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Collider[] AvatarColliders(AvatarHandle avatar)
        {
            uint listed = 0;
            AvatarColliders(avatar, null, (uint)sizeof(Collider), &listed);
            for (;;)
            {
                var list = new Collider[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Collider* first = list) AvatarColliders(avatar, first, (uint)sizeof(Collider),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarColliders(AvatarHandle avatar, Collider[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Collider none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarColliders(avatar, &none, (uint)sizeof(Collider), &listed);
            else fixed (Collider* first = into) AvatarColliders(avatar, first, (uint)sizeof(Collider),
                &listed);
            return (int)listed;
        }

        internal static Result AvatarJoints(AvatarHandle avatar, Joint* items, uint stride, uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_joints(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Joint[] AvatarJoints(AvatarHandle avatar)
        {
            uint listed = 0;
            AvatarJoints(avatar, null, (uint)sizeof(Joint), &listed);
            for (;;)
            {
                var list = new Joint[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Joint* first = list) AvatarJoints(avatar, first, (uint)sizeof(Joint), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarJoints(AvatarHandle avatar, Joint[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Joint none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarJoints(avatar, &none, (uint)sizeof(Joint), &listed);
            else fixed (Joint* first = into) AvatarJoints(avatar, first, (uint)sizeof(Joint), &listed);
            return (int)listed;
        }

        internal static Result AvatarRig(AvatarHandle avatar, RigBone* items, uint stride, uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_rig(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static RigBone[] AvatarRig(AvatarHandle avatar)
        {
            uint listed = 0;
            AvatarRig(avatar, null, (uint)sizeof(RigBone), &listed);
            for (;;)
            {
                var list = new RigBone[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (RigBone* first = list) AvatarRig(avatar, first, (uint)sizeof(RigBone), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarRig(AvatarHandle avatar, RigBone[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            RigBone none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarRig(avatar, &none, (uint)sizeof(RigBone), &listed);
            else fixed (RigBone* first = into) AvatarRig(avatar, first, (uint)sizeof(RigBone), &listed);
            return (int)listed;
        }

        internal static Result AvatarMeasure(AvatarHandle avatar, Measurement* items, uint stride,
            uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_measure(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Measurement[] AvatarMeasure(AvatarHandle avatar)
        {
            uint listed = 0;
            AvatarMeasure(avatar, null, (uint)sizeof(Measurement), &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) AvatarMeasure(avatar, first, (uint)sizeof(Measurement),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarMeasure(AvatarHandle avatar, Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarMeasure(avatar, &none, (uint)sizeof(Measurement), &listed);
            else fixed (Measurement* first = into) AvatarMeasure(avatar, first, (uint)sizeof(Measurement),
                &listed);
            return (int)listed;
        }

        internal static Result AvatarMeasureOwn(AvatarHandle avatar, void* text, ulong byteCount,
            Measurement* items, uint stride, uint* count)
        {
            bool avatarHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_measure_own(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), text, byteCount, items, stride,
                    count));
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Measurement[] AvatarMeasureOwn(AvatarHandle avatar, void* text, ulong byteCount)
        {
            uint listed = 0;
            AvatarMeasureOwn(avatar, text, byteCount, null, (uint)sizeof(Measurement), &listed);
            for (;;)
            {
                var list = new Measurement[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Measurement* first = list) AvatarMeasureOwn(avatar, text, byteCount, first,
                        (uint)sizeof(Measurement), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int AvatarMeasureOwn(AvatarHandle avatar, void* text, ulong byteCount,
            Measurement[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Measurement none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) AvatarMeasureOwn(avatar, text, byteCount, &none, (uint)sizeof(Measurement),
                &listed);
            else fixed (Measurement* first = into) AvatarMeasureOwn(avatar, text, byteCount, first,
                (uint)sizeof(Measurement), &listed);
            return (int)listed;
        }

        internal static Result AvatarAcquire(AvatarHandle avatar, FrameHandle @out)
        {
            bool avatarHeld = false;
            var outId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_acquire(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result AvatarAcquireRest(AvatarHandle avatar, FrameHandle @out)
        {
            bool avatarHeld = false;
            var outId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_avatar_acquire_rest(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)), &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
            }
        }

        internal static Result GarmentList(ContextHandle context, DataName* items, uint stride, uint* count)
        {
            bool contextHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_list(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static DataName[] GarmentList(ContextHandle context)
        {
            uint listed = 0;
            GarmentList(context, null, (uint)sizeof(DataName), &listed);
            for (;;)
            {
                var list = new DataName[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (DataName* first = list) GarmentList(context, first, (uint)sizeof(DataName),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int GarmentList(ContextHandle context, DataName[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            DataName none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) GarmentList(context, &none, (uint)sizeof(DataName), &listed);
            else fixed (DataName* first = into) GarmentList(context, first, (uint)sizeof(DataName), &listed);
            return (int)listed;
        }

        internal static Result GarmentLoad(ContextHandle context, void* bytes, ulong byteCount,
            GarmentHandle @out)
        {
            bool contextHeld = false;
            var outId = new GarmentId();
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_load(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), bytes, byteCount, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result GarmentOpen(ContextHandle context, byte* name, GarmentHandle @out)
        {
            bool contextHeld = false;
            var outId = new GarmentId();
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_open(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), name, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result GarmentDestroy(GarmentHandle garment)
        {
            bool garmentHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_destroy(
                    new GarmentId(VfitHandle.Hold(garment, ref garmentHeld))));
                return result;
            }
            finally
            {
                if (garmentHeld) garment.DangerousRelease();
            }
        }

        internal static Result GarmentDescribe(GarmentHandle garment, GarmentInfo* @out)
        {
            bool garmentHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_describe(
                    new GarmentId(VfitHandle.Hold(garment, ref garmentHeld)), @out));
                return result;
            }
            finally
            {
                if (garmentHeld) garment.DangerousRelease();
            }
        }

        internal static GarmentInfo GarmentDescribe(GarmentHandle garment)
        {
            var value = new GarmentInfo();
            value.StructSize = (uint)sizeof(GarmentInfo);
            GarmentDescribe(garment, &value);
            return value;
        }

        internal static Result GarmentParts(GarmentHandle garment, GarmentPart* items, uint stride,
            uint* count)
        {
            bool garmentHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_garment_parts(
                    new GarmentId(VfitHandle.Hold(garment, ref garmentHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (garmentHeld) garment.DangerousRelease();
            }
        }

        internal static GarmentPart[] GarmentParts(GarmentHandle garment)
        {
            uint listed = 0;
            GarmentParts(garment, null, (uint)sizeof(GarmentPart), &listed);
            for (;;)
            {
                var list = new GarmentPart[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (GarmentPart* first = list) GarmentParts(garment, first, (uint)sizeof(GarmentPart),
                        &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int GarmentParts(GarmentHandle garment, GarmentPart[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            GarmentPart none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) GarmentParts(garment, &none, (uint)sizeof(GarmentPart), &listed);
            else fixed (GarmentPart* first = into) GarmentParts(garment, first, (uint)sizeof(GarmentPart),
                &listed);
            return (int)listed;
        }

        internal static uint GarmentSizeLabel(GarmentHandle garment, uint index, byte* buffer, uint capacity)
        {
            bool garmentHeld = false;
            try
            {
                return Native.vfit_garment_size_label(
                    new GarmentId(VfitHandle.Hold(garment, ref garmentHeld)), index, buffer, capacity);
            }
            finally
            {
                if (garmentHeld) garment.DangerousRelease();
            }
        }

        internal static string GarmentSizeLabel(GarmentHandle garment, uint index)
        {
            byte* few = stackalloc byte[Utf8Text.Few];
            uint length = GarmentSizeLabel(garment, index, few, Utf8Text.Few);
            if (length < Utf8Text.Few) return Utf8Text.Read(few, Utf8Text.Few);
            var many = new byte[length + 1];
            fixed (byte* bytes = many)
            {
                GarmentSizeLabel(garment, index, bytes, length + 1);
                return Utf8Text.Read(bytes, many.Length);
            }
        }

        internal static Result ClothCreate(AvatarHandle avatar, GarmentHandle garment, ClothDesc* desc,
            ClothHandle @out)
        {
            bool avatarHeld = false;
            bool garmentHeld = false;
            var outId = new ClothId();
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_create(
                    new AvatarId(VfitHandle.Hold(avatar, ref avatarHeld)),
                    new GarmentId(VfitHandle.Hold(garment, ref garmentHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (avatarHeld) avatar.DangerousRelease();
                if (garmentHeld) garment.DangerousRelease();
            }
        }

        internal static Result ClothDestroy(ClothHandle cloth)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_destroy(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothReset(ClothHandle cloth)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_reset(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothSetSize(ClothHandle cloth, byte* sizeLabel)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_set_size(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), sizeLabel));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothStep(ClothHandle cloth, float dt)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_step(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), dt));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothBeginStep(ClothHandle cloth, float dt)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_begin_step(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), dt));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothEndStep(ClothHandle cloth)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_end_step(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothCarry(ClothHandle cloth)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_carry(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothTeleport(ClothHandle cloth)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_teleport(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothSetWind(ClothHandle cloth, float* wind)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_set_wind(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), wind));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothSetQuality(ClothHandle cloth, uint substeps, float budgetMs)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_set_quality(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), substeps, budgetMs));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothWearOver(ClothHandle cloth, ClothHandle inner)
        {
            bool clothHeld = false;
            bool innerHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_wear_over(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), new ClothId(VfitHandle.Hold(inner,
                    ref innerHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
                if (innerHeld) inner.DangerousRelease();
            }
        }

        internal static Result PropCreate(ContextHandle context, PropDesc* desc, PropHandle @out)
        {
            bool contextHeld = false;
            var outId = new PropId();
            try
            {
                Result result = VfitException.Check(Native.vfit_prop_create(
                    new ContextId(VfitHandle.Hold(context, ref contextHeld)), desc, &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (contextHeld) context.DangerousRelease();
            }
        }

        internal static Result PropDestroy(PropHandle prop)
        {
            bool propHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_prop_destroy(
                    new PropId(VfitHandle.Hold(prop, ref propHeld))));
                return result;
            }
            finally
            {
                if (propHeld) prop.DangerousRelease();
            }
        }

        internal static Result PropMove(PropHandle prop, float* position, float* rotation)
        {
            bool propHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_prop_move(
                    new PropId(VfitHandle.Hold(prop, ref propHeld)), position, rotation));
                return result;
            }
            finally
            {
                if (propHeld) prop.DangerousRelease();
            }
        }

        internal static Result PropDeform(PropHandle prop, float* positions, uint vertexCount)
        {
            bool propHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_prop_deform(
                    new PropId(VfitHandle.Hold(prop, ref propHeld)), positions, vertexCount));
                return result;
            }
            finally
            {
                if (propHeld) prop.DangerousRelease();
            }
        }

        internal static Result ClothAddProp(ClothHandle cloth, PropHandle prop)
        {
            bool clothHeld = false;
            bool propHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_add_prop(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), new PropId(VfitHandle.Hold(prop,
                    ref propHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
                if (propHeld) prop.DangerousRelease();
            }
        }

        internal static Result ClothRemoveProp(ClothHandle cloth, PropHandle prop)
        {
            bool clothHeld = false;
            bool propHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_remove_prop(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), new PropId(VfitHandle.Hold(prop,
                    ref propHeld))));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
                if (propHeld) prop.DangerousRelease();
            }
        }

        internal static Result ClothHideSkin(ClothHandle cloth, float marginM, byte* triangles, uint count)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_hide_skin(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), marginM, triangles, count));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothFit(ClothHandle cloth, FitZone* items, uint stride, uint* count)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_fit(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), items, stride, count));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static FitZone[] ClothFit(ClothHandle cloth)
        {
            uint listed = 0;
            ClothFit(cloth, null, (uint)sizeof(FitZone), &listed);
            for (;;)
            {
                var list = new FitZone[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (FitZone* first = list) ClothFit(cloth, first, (uint)sizeof(FitZone), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int ClothFit(ClothHandle cloth, FitZone[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            FitZone none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) ClothFit(cloth, &none, (uint)sizeof(FitZone), &listed);
            else fixed (FitZone* first = into) ClothFit(cloth, first, (uint)sizeof(FitZone), &listed);
            return (int)listed;
        }

        internal static Result ClothFitMap(ClothHandle cloth, float* values, uint count)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_fit_map(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), values, count));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothAcquire(ClothHandle cloth, FrameHandle @out)
        {
            bool clothHeld = false;
            var outId = new FrameId();
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_acquire(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), &outId));
                @out.Put(outId.Value);
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result ClothDescribe(ClothHandle cloth, ClothStats* @out)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_describe(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), @out));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static ClothStats ClothDescribe(ClothHandle cloth)
        {
            var value = new ClothStats();
            value.StructSize = (uint)sizeof(ClothStats);
            ClothDescribe(cloth, &value);
            return value;
        }

        internal static Result ClothStateHash(ClothHandle cloth, ulong* @out)
        {
            bool clothHeld = false;
            try
            {
                Result result = VfitException.Check(Native.vfit_cloth_state_hash(
                    new ClothId(VfitHandle.Hold(cloth, ref clothHeld)), @out));
                return result;
            }
            finally
            {
                if (clothHeld) cloth.DangerousRelease();
            }
        }

        internal static Result OutfitCheck(ClothId* cloths, uint clothCount, Crossing* items, uint stride,
            uint* count)
        {
            Result result = VfitException.Check(Native.vfit_outfit_check(
                cloths, clothCount, items, stride, count));
            return result;
        }

        internal static Crossing[] OutfitCheck(ClothId* cloths, uint clothCount)
        {
            uint listed = 0;
            OutfitCheck(cloths, clothCount, null, (uint)sizeof(Crossing), &listed);
            for (;;)
            {
                var list = new Crossing[listed];
                if (listed == 0) return list;
                try
                {
                    fixed (Crossing* first = list) OutfitCheck(cloths, clothCount, first,
                        (uint)sizeof(Crossing), &listed);
                }
                catch (VfitException error) when (error.Code == Result.ErrorCapacity && listed > list.Length)
                {
                    continue;   // it grew between the two calls
                }
                if (listed < list.Length) Array.Resize(ref list, (int)listed);
                return list;
            }
        }

        internal static int OutfitCheck(ClothId* cloths, uint clothCount, Crossing[] into)
        {
            if (into == null) throw new ArgumentNullException("into");
            Crossing none;
            uint listed = (uint)into.Length;
            // An empty array does not ask for the count: only null does.
            if (listed == 0) OutfitCheck(cloths, clothCount, &none, (uint)sizeof(Crossing), &listed);
            else fixed (Crossing* first = into) OutfitCheck(cloths, clothCount, first,
                (uint)sizeof(Crossing), &listed);
            return (int)listed;
        }

        internal static Result OutfitSkin(ClothId* cloths, uint clothCount, FrameHandle @out,
            uint* crossingPairs)
        {
            var outId = new FrameId();
            Result result = VfitException.Check(Native.vfit_outfit_skin(
                cloths, clothCount, &outId, crossingPairs));
            @out.Put(outId.Value);
            return result;
        }
    }

    public sealed partial class ContextHandle : VfitHandle
    {
        internal ContextHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_context_destroy(new ContextId(id)); }
    }

    public sealed partial class SensorHandle : VfitHandle
    {
        internal SensorHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_sensor_close(new SensorId(id)); }
    }

    public sealed partial class FrameHandle : VfitHandle
    {
        internal FrameHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_frame_release(new FrameId(id)); }
    }

    public sealed partial class TrackerHandle : VfitHandle
    {
        internal TrackerHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_tracker_destroy(new TrackerId(id)); }
    }

    public sealed partial class ScanHandle : VfitHandle
    {
        internal ScanHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_scan_destroy(new ScanId(id)); }
    }

    public sealed partial class SizeChartHandle : VfitHandle
    {
        internal SizeChartHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_size_chart_destroy(new SizeChartId(id)); }
    }

    public sealed partial class MotionHandle : VfitHandle
    {
        internal MotionHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_motion_destroy(new MotionId(id)); }
    }

    public sealed partial class AvatarHandle : VfitHandle
    {
        internal AvatarHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_avatar_destroy(new AvatarId(id)); }
    }

    public sealed partial class GarmentHandle : VfitHandle
    {
        internal GarmentHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_garment_destroy(new GarmentId(id)); }
    }

    public sealed partial class ClothHandle : VfitHandle
    {
        internal ClothHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_cloth_destroy(new ClothId(id)); }
    }

    public sealed partial class RecorderHandle : VfitHandle
    {
        internal RecorderHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_recorder_destroy(new RecorderId(id)); }
    }

    public sealed partial class PropHandle : VfitHandle
    {
        internal PropHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_prop_destroy(new PropId(id)); }
    }

    public sealed partial class PopulationHandle : VfitHandle
    {
        internal PopulationHandle(VfitHandle parent) : base(parent) { }
        internal override Result End(ulong id) { return Native.vfit_population_destroy(
            new PopulationId(id)); }
    }
}
