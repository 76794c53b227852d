// A handle of the library, which Dispose or the finalizer gives back exactly once.
using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace Vfit
{
    /// <summary>
    /// A call holds the handle while it runs, so that no finalizer ends an object in the middle of a step. A
    /// child holds its parent: in a tree without references, children end first.
    /// </summary>
    public abstract class VfitHandle : SafeHandle
    {
        private readonly VfitHandle parent;
        // SafeHandle itself lets calls through as long as a child holds its disposed parent.
        private volatile bool disposed;

        internal VfitHandle(VfitHandle parent) : base(IntPtr.Zero, true)
        {
            if (IntPtr.Size != 8) throw new PlatformNotSupportedException("vfit needs a 64-bit process");
            if (parent == null) return;
            bool held = false;
            Hold(parent, ref held);
            this.parent = parent;
        }

        /// <summary>Always false: also a handle that is empty yet has its parent to let go of.</summary>
        public override bool IsInvalid
        {
            get { return false; }
        }

        /// <summary>Null before the object was made and after it was closed.</summary>
        internal bool IsEmpty
        {
            get { return handle == IntPtr.Zero; }
        }

        /// <summary>Dispose was called.</summary>
        internal bool IsDisposed
        {
            get { return disposed; }
        }

        /// <summary>The library's function that destroys, closes or releases.</summary>
        internal abstract Result End(ulong id);

        /// <summary>Called once the library has let go of the object.</summary>
        protected virtual void Ended() { }

        /// <summary>
        /// The id for one call; null gives the library's null handle. Release if held is true.
        /// </summary>
        internal static ulong Hold(VfitHandle handle, ref bool held)
        {
            if (handle == null) return 0;
            if (handle.disposed) throw new ObjectDisposedException(handle.GetType().Name);
            handle.DangerousAddRef(ref held);
            return (ulong)handle.handle;
        }

        /// <summary>Takes over a new id and ends the last: one object holds frame after frame.</summary>
        internal void Put(ulong id)
        {
            bool held = false;
            try
            {
                Hold(this, ref held);
                ulong before = Exchange(id);
                if (before != 0) End(before);
            }
            catch (ObjectDisposedException)
            {
                if (id != 0) End(id);
                throw;
            }
            finally
            {
                if (held) DangerousRelease();
            }
        }

        /// <summary>
        /// Ends the object now, also while another thread is in a call on it: the library lets that call
        /// finish, or wakes it if it waits. If the object is BUSY, the last call that returns ends it.
        /// </summary>
        internal void EndNow()
        {
            disposed = true;
            ulong id = Exchange(0);
            Result result = id == 0 ? Result.Ok : End(id);
            if (result == Result.ErrorBusy) Exchange(id);
            Dispose();
            if (id == 0 || result == Result.ErrorBusy) return;
            Ended();
            // Its parent may have taken it along: then it is gone, and that is all that was asked for.
            if (result != Result.ErrorHandle) VfitException.Check(result);
        }

        protected override bool ReleaseHandle()
        {
            ulong id = Exchange(0);
            if (id != 0)
            {
                End(id);
                Ended();
            }
            if (parent != null) parent.DangerousRelease();
            return true;
        }

        private ulong Exchange(ulong id)
        {
            return (ulong)(long)Interlocked.Exchange(ref handle, (IntPtr)(long)id);
        }
    }

    /// <summary>What all classes of the binding share.</summary>
    public abstract class VfitObject<THandle> : IDisposable where THandle : VfitHandle
    {
        internal THandle Handle { get; private set; }

        internal VfitObject(THandle handle)
        {
            Handle = handle;
        }

        /// <summary>
        /// Closed by Dispose. If its context was closed, an object learns it at the next call.
        /// </summary>
        public bool IsClosed
        {
            get { return Handle.IsDisposed; }
        }

        public void Dispose()
        {
            Handle.EndNow();
        }

        /// <summary>The handle of an argument that must be there.</summary>
        internal static THandle Of(VfitObject<THandle> value, string name)
        {
            if (value == null) throw new ArgumentNullException(name);
            return value.Handle;
        }
    }
}
