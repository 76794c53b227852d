// The end of all contexts where the scripts that made them go: at quit, and where a play mode starts without a reload.
using System;
using UnityEngine;

namespace Vfit.Unity
{
    public static class VfitProcess
    {
        /// <summary>
        /// Ends what an earlier play mode has left: with "Reload Domain" switched off statics live on, and so would cameras.
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
                Debug.LogWarning("vfit: the native library is not installed; see the package's documentation");
            }
            catch (VfitException error)
            {
                Debug.LogError("vfit: " + error.Message);
            }
        }
    }
}
