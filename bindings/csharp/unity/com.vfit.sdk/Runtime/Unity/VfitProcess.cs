// Ends all contexts when the scripts that made them end: at quit, and when play mode starts without a reload.
using System;
using UnityEngine;

namespace Vfit.Unity
{
    public static class VfitProcess
    {
        /// <summary>
        /// Ends the contexts that an earlier play mode left: with "Reload Domain" off, static fields and open
        /// cameras outlive it.
        /// </summary>
        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void OnPlay()
        {
            Shutdown();
            Application.quitting -= Shutdown;
            Application.quitting += Shutdown;
        }

        /// <summary>Joins all threads of vfit. Objects that are left give ErrorHandle from then on.</summary>
        public static void Shutdown()
        {
            try
            {
                Library.Shutdown();
            }
            catch (DllNotFoundException)
            {
                Debug.LogWarning(
                    "vfit: the native library is not installed; see the package's documentation");
            }
            catch (VfitException error)
            {
                Debug.LogError("vfit: " + error.Message);
            }
        }
    }
}
