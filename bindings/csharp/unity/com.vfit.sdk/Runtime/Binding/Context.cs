// The context: all objects are made in one, and contexts share nothing.
using System;

namespace Vfit
{
    /// <summary>Settings of a context; what is left out has the library's default.</summary>
    public sealed class ContextOptions
    {
        public Axes Axes;
        public ContextFlags Flags;
        /// <summary>
        /// Gets each log line, on any thread; what it throws is swallowed. Without it lines are polled with
        /// Context.NextLog, which fits hosts that reload their code, and warnings go to stderr as well.
        /// </summary>
        public Action<LogLevel, string> Log;
        /// <summary>Null: vfit_plugins beside the library.</summary>
        public string PluginDir;
        /// <summary>Null: vfit_data beside the library.</summary>
        public string DataDir;
        /// <summary>0: physical cores less one.</summary>
        public int WorkerCount;
        /// <summary>
        /// The host's job system: C function pointers vfit_submit_fn and vfit_wait_fn and their first
        /// argument. Not together with Log, which has the same first argument.
        /// </summary>
        public IntPtr NativeSubmit, NativeWait, NativeUser;
    }

    public sealed unsafe class Context : VfitObject<ContextHandle>
    {
        public Context() : this(null) { }

        public Context(ContextOptions options) : base(new ContextHandle(null))
        {
            options = options ?? new ContextOptions();
            if (options.WorkerCount < 0)
                throw new ArgumentOutOfRangeException("options", "WorkerCount is below 0");
            bool hasJobs = options.NativeSubmit != IntPtr.Zero || options.NativeWait != IntPtr.Zero;
            if (hasJobs && options.Log != null)
                throw new ArgumentException("Log and a native job system exclude each other", "options");
            byte[] plugins = Utf8Text.Encode(options.PluginDir), data = Utf8Text.Encode(options.DataDir);
            var desc = new ContextDesc();
            desc.StructSize = (uint)sizeof(ContextDesc);
            desc.ApiVersion = Counts.HeaderVersion;
            desc.Flags = options.Flags;
            desc.Axes = options.Axes;
            desc.WorkerCount = (uint)options.WorkerCount;
            desc.submit = options.NativeSubmit;
            desc.wait = options.NativeWait;
            desc.user = (void*)options.NativeUser;
            if (options.Log != null)
            {
                desc.log = LogCallback.Function;
                desc.user = (void*)Handle.SendLogTo(options.Log);
            }
            fixed (byte* pluginDir = plugins, dataDir = data)
            {
                desc.pluginDir = pluginDir;
                desc.dataDir = dataDir;
                try
                {
                    Calls.ContextCreate(&desc, Handle);
                }
                catch
                {
                    Handle.StopLog();
                    throw;
                }
            }
        }

        /// <summary>Now, on the clock of all time stamps of this context.</summary>
        public long TimeNs
        {
            get
            {
                long now;
                Calls.ContextTime(Handle, &now);
                return now;
            }
        }

        /// <summary>Live handles and frames, and the memory that frames hold.</summary>
        public ContextStats Stats()
        {
            return Calls.ContextDescribe(Handle);
        }

        /// <summary>Time spent in each stage.</summary>
        public Profile[] Profiles()
        {
            return Calls.ProfileList(Handle);
        }

        /// <summary>The same into an array of one's own; returns how many.</summary>
        public int Profiles(Profile[] into)
        {
            return Calls.ProfileList(Handle, into);
        }

        public void ResetProfile()
        {
            Calls.ProfileReset(Handle);
        }

        /// <summary>The next log line; false: none. The library keeps the newest 256.</summary>
        public bool NextLog(out LogLevel level, out string message)
        {
            const int capacity = 2048;  // lines are one sentence, at most with a path in it
            byte* line = stackalloc byte[capacity];
            LogLevel read;
            bool any = Calls.LogNext(Handle, &read, line, capacity) == Result.Ok;
            level = any ? read : LogLevel.Debug;
            message = any ? Utf8Text.Read(line, capacity) : "";
            return any;
        }

        /// <summary>
        /// Where another camera's world space lies in this one's, from points that both saw at the same
        /// times: middle joints (Pelvis, Chest, Neck, Head) of a person who walks about. Returns what is left
        /// between them.
        /// </summary>
        public float AlignWorlds(Float3[] here, Float3[] there, out Float3 position, out Float4 rotation)
        {
            Arrays.Check(here, here == null ? 0 : here.Length, "here");
            Arrays.Check(there, here.Length, "there");
            var at = new Float3();
            var turn = new Float4();
            float rms = 0;
            fixed (Float3* a = here, b = there)
                Calls.WorldAlign(Handle, (float*)a, (float*)b, (uint)here.Length, &at.X, &turn.X, &rms);
            position = at;
            rotation = turn;
            return rms;
        }

        /// <summary>Loads a sensor plug-in from its file.</summary>
        public void LoadPlugin(string path)
        {
            fixed (byte* file = Utf8Text.Encode(path, "path")) Calls.PluginLoad(Handle, file);
        }

        public PluginInfo[] Plugins()
        {
            return Calls.PluginList(Handle);
        }

        /// <summary>The sensors that can be opened now.</summary>
        public SensorInfo[] Sensors()
        {
            return Calls.SensorList(Handle);
        }

        /// <summary>Rises when that list may have become another. Cheap: ask each frame.</summary>
        public ulong SensorChanges()
        {
            ulong count;
            Calls.SensorChanges(Handle, &count);
            return count;
        }

        /// <summary>Keys, values and ranges that Avatar.FromShape knows.</summary>
        public ShapeValue[] Shapes()
        {
            return Calls.ShapeList(Handle);
        }
    }
}
