// The component: opens a sensor, tracks the active person, drives a humanoid, fills the meshes of body and
// cloth.
using System;
using UnityEngine;

namespace Vfit.Unity
{
    public enum FittingState
    {
        Off,
        /// <summary>Frames come in, and nobody was seen yet.</summary>
        Waiting,
        /// <summary>The person is scanned; Guidance says what they should do.</summary>
        Scanning,
        /// <summary>The avatar follows.</summary>
        Following,
        /// <summary>The recording has ended.</summary>
        Ended,
        /// <summary>Error says why; enabling the component tries again.</summary>
        Failed
    }

    [AddComponentMenu("vfit/Fitting Room")]
    public sealed class FittingRoom : MonoBehaviour
    {
        public FittingSettings settings = new FittingSettings();

        [Tooltip("A humanoid character that moves as the person does. May be empty.")]
        public Animator humanoid;
        [Tooltip("Gets the person's body. At the identity below this object. May be empty.")]
        public MeshFilter bodyMesh;
        [Tooltip("Gets the garment. At the identity below this object. May be empty.")]
        public MeshFilter clothMesh;

        private FittingSession session;
        private HumanoidDriver driver;
        private MeshWriter body, cloth;

        public FittingState State { get; private set; }

        /// <summary>The sentence of the last failure, or empty.</summary>
        public string Error { get; private set; } = "";

        /// <summary>How far the scan is and what keeps it.</summary>
        public ScanState Scan
        {
            get { return session != null ? session.ScanState : default(ScanState); }
        }

        /// <summary>Once the scan is complete; makes a list, so not for each frame.</summary>
        public Measurement[] Measure()
        {
            return session != null ? session.Measure() : new Measurement[0];
        }

        private void OnEnable()
        {
            Error = "";
            Guard(() =>
            {
                session = new FittingSession(settings);
                if (humanoid != null) driver = new HumanoidDriver(humanoid);
                body = NewWriter(bodyMesh);
                cloth = NewWriter(clothMesh);
                State = session.State;
            });
        }

        private void Update()
        {
            if (session == null) return;
            try
            {
                session.Begin(Time.deltaTime);
                State = session.State;
            }
            catch (VfitException error)
            {
                Fail(error);
            }
        }

        /// <summary>After animation, so that a controller on the humanoid does not undo the pose.</summary>
        private void LateUpdate()
        {
            if (session == null) return;
            try
            {
                session.End();
                if (driver != null && session.HasPose) driver.Apply(session.Pose);
                if (body != null && session.HasAvatar)
                {
                    body.Write(session.BodyFrame);
                    byte[] hidden = session.TakeHiddenSkin();
                    if (hidden != null) body.Hide(hidden);
                }
                if (cloth != null && session.HasCloth) cloth.Write(session.ClothFrame);
            }
            catch (VfitException error)
            {
                Fail(error);
            }
        }

        private void OnDisable()
        {
            Close();
            if (State != FittingState.Failed) State = FittingState.Off;
        }

        private void OnDestroy()
        {
            DestroyMesh(body);
            DestroyMesh(cloth);
            body = cloth = null;
        }

        private MeshWriter NewWriter(MeshFilter filter)
        {
            if (filter == null) return null;
            var mesh = new Mesh { name = "vfit" };
            if (filter == bodyMesh) DestroyMesh(body);
            else DestroyMesh(cloth);
            filter.sharedMesh = mesh;
            return new MeshWriter(mesh);
        }

        private static void DestroyMesh(MeshWriter writer)
        {
            if (writer != null) Destroy(writer.Mesh);
        }

        private void Guard(Action open)
        {
            try
            {
                open();
            }
            catch (Exception error)     // no library, no such sensor, or no humanoid: Error says which
            {
                Fail(error);
            }
        }

        /// <summary>Says it once and stops: an error that comes each frame would fill the console.</summary>
        private void Fail(Exception error)
        {
            Error = error.Message;
            State = FittingState.Failed;
            Debug.LogError("vfit: " + error.Message, this);
            Close();
            enabled = false;
        }

        private void Close()
        {
            if (session != null) session.Dispose();
            session = null;
            driver = null;
        }
    }
}
