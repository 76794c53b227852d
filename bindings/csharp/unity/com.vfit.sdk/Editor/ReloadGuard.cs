// Before scripts are reloaded, all threads of vfit end: none may call into code that is being unloaded.
using UnityEditor;

namespace Vfit.Unity.Editor
{
    [InitializeOnLoad]
    internal static class ReloadGuard
    {
        static ReloadGuard()
        {
            AssemblyReloadEvents.beforeAssemblyReload += VfitProcess.Shutdown;
            EditorApplication.playModeStateChanged += OnPlayMode;
        }

        private static void OnPlayMode(PlayModeStateChange change)
        {
            if (change == PlayModeStateChange.EnteredEditMode) VfitProcess.Shutdown();
        }
    }
}
