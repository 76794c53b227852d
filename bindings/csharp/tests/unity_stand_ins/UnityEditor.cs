// Stand-ins for what the package uses of UnityEditor.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEditor
{
    public class Editor
    {
        public UnityEngine.Object target;

        public virtual void OnInspectorGUI() { }

        public virtual bool RequiresConstantRepaint()
        {
            return false;
        }

        protected bool DrawDefaultInspector()
        {
            return true;
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomEditorAttribute : Attribute
    {
        public CustomEditorAttribute(Type type) { }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class InitializeOnLoadAttribute : Attribute { }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();

        public static event AssemblyReloadCallback beforeAssemblyReload;

        public static void Reload()
        {
            if (beforeAssemblyReload != null) beforeAssemblyReload();
        }
    }

    public enum PlayModeStateChange
    {
        EnteredEditMode, ExitingEditMode, EnteredPlayMode, ExitingPlayMode
    }

    public static class EditorApplication
    {
        public static event Action<PlayModeStateChange> playModeStateChanged;

        public static void Change(PlayModeStateChange change)
        {
            if (playModeStateChanged != null) playModeStateChanged(change);
        }
    }

    public enum MessageType
    {
        None, Info, Warning, Error
    }

    public static class EditorGUILayout
    {
        public static readonly List<string> boxes = new List<string>();

        public static void HelpBox(string message, MessageType type)
        {
            boxes.Add(message);
        }
    }

    public static class EditorUtility
    {
        public static void SetDirty(UnityEngine.Object target) { }
    }

    public static class Undo
    {
        public static void RecordObject(UnityEngine.Object target, string name) { }
    }
}

namespace UnityEditor.Build
{
    public interface IOrderedCallback
    {
        int callbackOrder { get; }
    }

    public interface IPostprocessBuildWithReport : IOrderedCallback
    {
        void OnPostprocessBuild(Reporting.BuildReport report);
    }
}

namespace UnityEditor.Build.Reporting
{
    public struct BuildSummary
    {
        public string outputPath { get; set; }
    }

    public sealed class BuildReport : UnityEngine.Object
    {
        public BuildSummary summary { get; set; }
    }
}

namespace UnityEditor.PackageManager
{
    public sealed class PackageInfo
    {
        public string resolvedPath { get; set; }

        public static PackageInfo FindForAssembly(System.Reflection.Assembly assembly)
        {
            return null;
        }
    }
}
