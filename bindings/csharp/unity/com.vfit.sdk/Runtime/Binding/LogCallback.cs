// Log lines to a delegate of the host, through one static function, the only kind that ahead-of-time
// compilers can export.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Vfit
{
    /// <summary>Marks functions that native code calls. IL2CPP looks at the attribute's name only.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) { }
    }

    internal static unsafe class LogCallback
    {
        // Kept for the life of the process: contexts hold the pointer.
        private static readonly LogFn kept = OnLine;
        private static readonly Dictionary<long, Action<LogLevel, string>> receivers =
            new Dictionary<long, Action<LogLevel, string>>();
        private static long lastKey;

        internal static readonly IntPtr Function = Marshal.GetFunctionPointerForDelegate(kept);

        /// <summary>The key that the library returns with each line: objects have no fixed address.</summary>
        internal static long Add(Action<LogLevel, string> receiver)
        {
            lock (receivers)
            {
                receivers.Add(++lastKey, receiver);
                return lastKey;
            }
        }

        internal static void Remove(long key)
        {
            lock (receivers) receivers.Remove(key);
        }

        [MonoPInvokeCallback(typeof(LogFn))]
        private static void OnLine(IntPtr user, LogLevel level, byte* message)
        {
            try
            {
                Action<LogLevel, string> receiver;
                lock (receivers) receivers.TryGetValue((long)user, out receiver);
                if (receiver != null) receiver(level, Utf8Text.Read(message, int.MaxValue));
            }
            catch
            {
                // Native code is above: nothing may be thrown into it.
            }
        }
    }

    public sealed partial class ContextHandle
    {
        private long logKey;

        internal long SendLogTo(Action<LogLevel, string> receiver)
        {
            return logKey = LogCallback.Add(receiver);
        }

        internal void StopLog()
        {
            if (logKey != 0) LogCallback.Remove(logKey);
            logKey = 0;
        }

        protected override void Ended()
        {
            StopLog();
        }
    }
}
