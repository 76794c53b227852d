// Stand-ins for the objects of UnityEngine that the package uses. A test calls their messages as the engine
// does.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        public string name = "";
        public bool destroyed;

        public static void Destroy(Object o)
        {
            o.destroyed = true;
        }
    }

    public class Component : Object
    {
        public GameObject gameObject;

        public Transform transform
        {
            get { return gameObject.transform; }
        }
    }

    public class Behaviour : Component
    {
        private bool isEnabled = true;

        public bool enabled
        {
            get { return isEnabled; }
            set
            {
                bool was = isEnabled;
                isEnabled = value;
                if (was && !value) Messages.Send(this, "OnDisable");
                if (!was && value) Messages.Send(this, "OnEnable");
            }
        }
    }

    public class MonoBehaviour : Behaviour { }

    /// <summary>Calls a private message of a component, as the engine does.</summary>
    public static class Messages
    {
        public static void Send(object target, string message)
        {
            System.Reflection.MethodInfo method = target.GetType().GetMethod(
                message, System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic);
            if (method != null) ((Action)Delegate.CreateDelegate(typeof(Action), target, method))();
        }
    }

    public sealed class GameObject : Object
    {
        public readonly List<Component> components = new List<Component>();
        public readonly Transform transform;

        public GameObject(string name)
        {
            this.name = name;
            transform = new Transform { gameObject = this, name = name };
        }

        public bool active = true;

        public void SetActive(bool value)
        {
            bool was = active;
            active = value;
            if (was == value) return;
            foreach (Component c in components.ToArray())
                if (c is MonoBehaviour && ((MonoBehaviour)c).enabled)
                    Messages.Send(c, value ? "OnEnable" : "OnDisable");
        }

        public T AddComponent<T>() where T : Component, new()
        {
            var component = new T { gameObject = this, name = name };
            components.Add(component);
            if (active && component is MonoBehaviour) Messages.Send(component, "OnEnable");
            return component;
        }
    }

    public sealed class Transform : Component
    {
        public Transform parent;
        public Vector3 localPosition;
        public Vector3 localScale = Vector3.one;
        public Quaternion localRotation = Quaternion.identity;

        public void SetParent(Transform newParent, bool worldPositionStays)
        {
            parent = newParent;
        }

        public Quaternion rotation
        {
            get { return parent == null ? localRotation : parent.rotation * localRotation; }
            set { localRotation = parent == null ? value : Quaternion.Inverse(parent.rotation) * value; }
        }

        public Vector3 position
        {
            get { return parent == null ? localPosition : parent.TransformPoint(localPosition); }
            set
            {
                localPosition = value;
                if (parent == null) return;
                Vector3 v = Quaternion.Inverse(parent.rotation) * (value - parent.position);
                Vector3 s = parent.lossyScale;
                localPosition = new Vector3(v.x / s.x, v.y / s.y, v.z / s.z);
            }
        }

        public Vector3 lossyScale
        {
            get { return parent == null ? localScale : Vector3.Scale(parent.lossyScale, localScale); }
        }

        public Vector3 TransformPoint(Vector3 p)
        {
            return position + rotation * Vector3.Scale(lossyScale, p);
        }
    }

    public enum HumanBodyBones
    {
        Hips = 0, LeftUpperLeg = 1, RightUpperLeg = 2, LeftLowerLeg = 3, RightLowerLeg = 4,
        LeftFoot = 5, RightFoot = 6,
        Spine = 7, Chest = 8, Neck = 9, Head = 10, LeftShoulder = 11, RightShoulder = 12, LeftUpperArm = 13,
        RightUpperArm = 14, LeftLowerArm = 15, RightLowerArm = 16, LeftHand = 17, RightHand = 18,
        LeftToes = 19,
        RightToes = 20, UpperChest = 54
    }

    public struct SkeletonBone
    {
        public string name;
        public Vector3 position, scale;
        public Quaternion rotation;
    }

    public struct HumanDescription
    {
        public SkeletonBone[] skeleton;
    }

    public sealed class Avatar : Object
    {
        public bool isHuman;
        public HumanDescription humanDescription;
    }

    public sealed class Animator : Behaviour
    {
        public Avatar avatar;
        public readonly Dictionary<HumanBodyBones, Transform> bones =
            new Dictionary<HumanBodyBones, Transform>();

        public Transform GetBoneTransform(HumanBodyBones bone)
        {
            Transform found;
            bones.TryGetValue(bone, out found);
            return found;
        }
    }

    /// <summary>Refuses what Unity refuses: indices beyond the vertices, normals of another number.</summary>
    public sealed class Mesh : Object
    {
        public Vector3[] vertices = new Vector3[0], normals = new Vector3[0];
        public Vector2[] uv = new Vector2[0];
        private int[] indices = new int[0];
        public Rendering.IndexFormat indexFormat;
        public int uploads, bounds;

        /// <summary>A copy, as in Unity.</summary>
        public int[] triangles
        {
            get { return (int[])indices.Clone(); }
        }

        public void MarkDynamic() { }

        public void Clear()
        {
            vertices = normals = new Vector3[0];
            uv = new Vector2[0];
            indices = new int[0];
        }

        public void SetVertices(Vector3[] values)
        {
            if (vertices.Length != values.Length) vertices = new Vector3[values.Length];
            Array.Copy(values, vertices, values.Length);
            uploads++;
        }

        public void SetNormals(Vector3[] values)
        {
            if (values.Length != vertices.Length) throw new ArgumentException("normals");
            if (normals.Length != values.Length) normals = new Vector3[values.Length];
            Array.Copy(values, normals, values.Length);
        }

        public void SetUVs(int channel, Vector2[] values)
        {
            if (values.Length != vertices.Length) throw new ArgumentException("uv");
            uv = (Vector2[])values.Clone();
        }

        public void SetTriangles(int[] values, int submesh)
        {
            foreach (int index in values)
                if (index < 0 || index >= vertices.Length) throw new ArgumentException("index " + index);
            if (indexFormat == Rendering.IndexFormat.UInt16 && vertices.Length > 65535)
                throw new ArgumentException("too many");
            indices = (int[])values.Clone();
        }

        public void RecalculateBounds()
        {
            bounds++;
        }
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh;
    }

    public sealed class Material : Object { }

    public sealed class MeshRenderer : Component
    {
        public Material sharedMaterial;
    }

    public static class Time
    {
        public static float deltaTime = 1 / 60f;
    }

    public static class Debug
    {
        public static readonly List<string> lines = new List<string>();

        public static void Log(object message)
        {
            lines.Add("log " + message);
        }

        public static void LogWarning(object message)
        {
            lines.Add("warning " + message);
        }

        public static void LogError(object message)
        {
            lines.Add("error " + message);
        }

        public static void LogError(object message, Object context)
        {
            LogError(message);
        }
    }

    public static class Application
    {
        public static event Action quitting;
        public static bool isPlaying;

        public static void Quit()
        {
            if (quitting != null) quitting();
        }
    }

    public static class GUILayout
    {
        /// <summary>What the test's user clicks.</summary>
        public static string clicked = "";

        public static bool Button(string text)
        {
            return clicked.Length > 0 && text.Contains(clicked);
        }

        public static void Label(string text) { }
    }

    public enum RuntimeInitializeLoadType
    {
        AfterSceneLoad, BeforeSceneLoad, AfterAssembliesLoaded, BeforeSplashScreen, SubsystemRegistration
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class RuntimeInitializeOnLoadMethodAttribute : Attribute
    {
        public RuntimeInitializeOnLoadMethodAttribute(RuntimeInitializeLoadType loadType) { }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenuAttribute : Attribute
    {
        public AddComponentMenuAttribute(string name) { }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute
    {
        public TooltipAttribute(string text) { }
    }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat
    {
        UInt16, UInt32
    }
}
