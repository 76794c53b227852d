// A built player gets the library's data, sensor plug-ins and modules: Unity copies the library alone.
using System.IO;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEngine;
using PackageInfo = UnityEditor.PackageManager.PackageInfo;

namespace Vfit.Unity.Editor
{
    internal sealed class PlayerFolders : IPostprocessBuildWithReport
    {
        private static readonly string[] folders = { "vfit_data", "vfit_plugins", "vfit_modules" };
        private static readonly string[] libraries = { "libvfit.so", "vfit.dll", "libvfit.dylib" };

        public int callbackOrder
        {
            get { return 0; }
        }

        public void OnPostprocessBuild(BuildReport report)
        {
            PackageInfo package = PackageInfo.FindForAssembly(typeof(PlayerFolders).Assembly);
            string player = Path.GetDirectoryName(report.summary.outputPath);
            if (package == null || Copy(Path.Combine(package.resolvedPath, "Plugins"), player) == 0)
                Debug.LogWarning("vfit: the player has no native library of vfit; its data was not copied");
        }

        /// <summary>Puts the folders beside each library of the player; returns how many there are.</summary>
        internal static int Copy(string plugins, string player)
        {
            int found = 0;
            foreach (string library in libraries)
            {
                string[] sources = Directory.Exists(plugins)
                    ? Directory.GetFiles(plugins, library, SearchOption.AllDirectories)
                    : new string[0];
                if (sources.Length == 0) continue;
                foreach (string target in Directory.GetFiles(player, library, SearchOption.AllDirectories))
                {
                    found++;
                    foreach (string folder in folders)
                        CopyFolder(
                            Path.Combine(Path.GetDirectoryName(sources[0]), folder),
                            Path.Combine(Path.GetDirectoryName(target), folder));
                }
            }
            return found;
        }

        private static void CopyFolder(string from, string to)
        {
            if (!Directory.Exists(from)) return;
            Directory.CreateDirectory(to);
            foreach (string file in Directory.GetFiles(from))
                if (!file.EndsWith(".meta")) File.Copy(file, Path.Combine(to, Path.GetFileName(file)), true);
            foreach (string folder in Directory.GetDirectories(from))
                CopyFolder(folder, Path.Combine(to, Path.GetFileName(folder)));
        }
    }
}
