// The component's life on a recording, against stand-ins for Unity: enabled, updated, disabled, reloaded.
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;
using Vfit.Tests;

namespace Vfit.Unity.Tests
{
    [TestFixture]
    public class FittingRoomTests
    {
        private FittingRoom room;

        [SetUp]
        public void MakeRoom()
        {
            Debug.lines.Clear();
            GUILayout.clicked = "";
            var owner = new GameObject("room") { active = false };
            room = owner.AddComponent<FittingRoom>();
            room.settings.sensor = Support.Recording();
            room.settings.realtime = false;
            room.settings.sex = Sex.Female;
            room.bodyMesh = new GameObject("body").AddComponent<MeshFilter>();
            room.clothMesh = new GameObject("cloth").AddComponent<MeshFilter>();
        }

        [TearDown]
        public void EndRoom()
        {
            room.gameObject.SetActive(false);
            Messages.Send(room, "OnDestroy");
            VfitProcess.Shutdown();
        }

        /// <summary>Rendered frames until the state, or the most; returns how many.</summary>
        private int RunUntil(FittingState state, int most)
        {
            Action update = Message("Update"), late = Message("LateUpdate");
            int frames = 0;
            for (; frames < most && room.State != state; frames++)
            {
                update();
                late();
                // As fast as it can play: the sensor's own thread decodes meanwhile.
                System.Threading.Thread.Sleep(2);
            }
            return frames;
        }

        private Action Message(string name)
        {
            return (Action)Delegate.CreateDelegate(typeof(Action), room,
                typeof(FittingRoom).GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic));
        }

        [Test]
        public void ThePersonIsScannedDressedAndFollowed()
        {
            room.gameObject.SetActive(true);
            Assert.AreEqual(FittingState.Waiting, room.State);
            RunUntil(FittingState.Following, 3000);
            Assert.AreEqual(FittingState.Following, room.State, room.Error);
            RunUntil(FittingState.Ended, 5);
            Assert.AreEqual(30u, room.Scan.FramesTaken);
            Assert.That(room.Measure().Select(m => m.Key), Has.Member("stature_m"));
            UnityEngine.Mesh body = room.bodyMesh.sharedMesh, cloth = room.clothMesh.sharedMesh;
            Assert.Greater(body.vertices.Length, 10000);
            Assert.AreEqual(body.vertices.Length, body.uv.Length);
            Assert.That(body.vertices.Max(v => v.y), Is.InRange(1.3f, 2.2f));
            Assert.Greater(cloth.vertices.Length, 1000);
            Assert.That(cloth.normals.All(n => Math.Abs(n.magnitude - 1) < 1e-3f));
            Assert.That(
                body.triangles.Length, Is.LessThan(6 * 13718).And.GreaterThan(10000),
                "hidden skin is left out");
            Assert.That(Debug.lines.Where(l => l.StartsWith("error")), Is.Empty);
        }

        [Test]
        public void ARenderedFrameMakesNoGarbage()
        {
            room.settings.scan = false;
            room.settings.sensor = "virtual:motion=demo&sex=f&sensor=kinect_v1_320";
            room.humanoid = StandInHumanoid.Make(false);
            room.gameObject.SetActive(true);
            RunUntil(FittingState.Following, 3000);
            Action update = Message("Update"), late = Message("LateUpdate");
            for (int i = 0; i < 30; i++)
            {
                update();
                late();
            }
            int before = room.clothMesh.sharedMesh.uploads;
            long bytes = GC.GetAllocatedBytesForCurrentThread();
            for (int i = 0; i < 300; i++)
            {
                update();
                late();
            }
            bytes = GC.GetAllocatedBytesForCurrentThread() - bytes;
            Console.WriteLine("garbage: " + bytes + " bytes in 300 frames of a FittingRoom");
            Assert.AreEqual(0, bytes);
            Assert.Greater(room.clothMesh.sharedMesh.uploads, before + 10, "the cloth moved meanwhile");
            Assert.AreEqual(FittingState.Following, room.State, room.Error);
        }

        [Test]
        public void ItPlaysInRealTimeAndStartsOver()
        {
            room.settings.scan = false;
            room.settings.sensor = "virtual:motion=demo&sensor=kinect_v1_320&frames=8";
            room.settings.realtime = true;
            room.gameObject.SetActive(true);
            DateTime end = DateTime.UtcNow.AddSeconds(2);
            while (DateTime.UtcNow < end) RunUntil(FittingState.Ended, 1);
            Assert.AreEqual(FittingState.Following, room.State, room.Error);
        }

        [Test]
        public void ARecordingEndsWhereItIsNotToStartOver()
        {
            room.settings.scan = false;
            room.settings.loop = false;
            room.settings.sensor = "virtual:sensor=kinect_v1_320&frames=4";
            room.gameObject.SetActive(true);
            RunUntil(FittingState.Ended, 3000);
            Assert.AreEqual(FittingState.Ended, room.State, room.Error);
            RunUntil(FittingState.Failed, 3);
            Assert.AreEqual(FittingState.Ended, room.State);
        }

        [Test]
        public void AFailureIsSaidOnceAndEnablingTriesAgain()
        {
            room.settings.sensor = "recording:/nowhere";
            room.gameObject.SetActive(true);
            Assert.AreEqual(FittingState.Failed, room.State);
            StringAssert.Contains("nowhere", room.Error);
            Assert.IsFalse(room.enabled);
            RunUntil(FittingState.Off, 5);
            Assert.AreEqual(1, Debug.lines.Count(l => l.StartsWith("error")));
            room.settings.sensor = Support.Recording();
            room.enabled = true;
            Assert.AreEqual(FittingState.Waiting, room.State, room.Error);
            Assert.AreEqual("", room.Error);
        }

        [Test]
        public void AnAnimatorThatIsNoHumanoidIsNamed()
        {
            room.humanoid = new GameObject("robot").AddComponent<Animator>();
            room.gameObject.SetActive(true);
            Assert.AreEqual(FittingState.Failed, room.State);
            StringAssert.Contains("robot", room.Error);
        }

        [Test]
        public void DisablingInMidStepAndEnablingAgainLeavesNothingBehind()
        {
            room.settings.scan = false;
            for (int i = 0; i < 3; i++)
            {
                room.gameObject.SetActive(true);
                RunUntil(FittingState.Following, 3000);
                Message("Update")();    // a cloth step has begun
                UnityEngine.Mesh mesh = room.bodyMesh.sharedMesh;
                room.gameObject.SetActive(false);
                Assert.AreEqual(FittingState.Off, room.State);
                room.gameObject.SetActive(true);
                Assert.IsTrue(mesh.destroyed, "each mesh is destroyed");
                room.gameObject.SetActive(false);
            }
        }

        [Test]
        public void AReloadOfScriptsEndsAllThreadsAndWhatIsLeftFailsCleanly()
        {
            System.Runtime.CompilerServices.RuntimeHelpers.RunClassConstructor(
                typeof(Editor.ReloadGuard).TypeHandle);
            room.settings.scan = false;
            room.gameObject.SetActive(true);
            RunUntil(FittingState.Following, 3000);
            UnityEditor.AssemblyReloadEvents.Reload();
            RunUntil(FittingState.Failed, 1);
            Assert.AreEqual(FittingState.Failed, room.State, "its context is gone");
            room.enabled = true;
            Assert.AreEqual(FittingState.Waiting, room.State, room.Error);
            UnityEditor.EditorApplication.Change(UnityEditor.PlayModeStateChange.EnteredEditMode);
            RunUntil(FittingState.Failed, 1);
            Assert.AreEqual(FittingState.Failed, room.State);
        }

        [Test]
        public void PlayWithoutAReloadBeginsClean()
        {
            room.gameObject.SetActive(true);
            const BindingFlags hidden = BindingFlags.Static | BindingFlags.NonPublic;
            MethodInfo onPlay = typeof(VfitProcess).GetMethod("OnPlay", hidden);
            onPlay.Invoke(null, null);
            onPlay.Invoke(null, null);
            RunUntil(FittingState.Failed, 1);
            Assert.AreEqual(FittingState.Failed, room.State, "left by the play mode before");
            room.enabled = true;
            Application.Quit();
            RunUntil(FittingState.Failed, 1);
            Assert.AreEqual(FittingState.Failed, room.State);
        }

        [Test]
        public void TheInspectorListsSensorsAndTakesOne()
        {
            var inspector = (UnityEditor.Editor)Activator.CreateInstance(typeof(Editor.FittingRoomEditor));
            inspector.target = room;
            GUILayout.clicked = "List sensors";
            inspector.OnInspectorGUI();
            GUILayout.clicked = "virtual:";
            inspector.OnInspectorGUI();
            StringAssert.StartsWith("virtual:", room.settings.sensor);
            Application.isPlaying = true;
            inspector.OnInspectorGUI();
            Application.isPlaying = false;
            StringAssert.Contains("Off", UnityEditor.EditorGUILayout.boxes.Last());
        }

        [Test]
        public void TheSampleSetsARoomUp()
        {
            var mirror = new GameObject("mirror").AddComponent<MirrorSample>();
            mirror.sensor = Support.Recording();
            Messages.Send(mirror, "Start");
            Assert.AreEqual(FittingState.Waiting, mirror.Room.State, mirror.Room.Error);
            Assert.AreNotSame(mirror.Room.bodyMesh, mirror.Room.clothMesh);
            Messages.Send(mirror, "Update");
            Messages.Send(mirror, "OnGUI");
            mirror.Room.gameObject.SetActive(false);
        }

        [Test]
        public void ABuiltPlayerGetsTheFoldersBesideItsLibrary()
        {
            string top = Support.TemporaryFolder(), player = Path.Combine(top, "out");
            string plugins = Path.Combine(top, "Plugins", "x86_64");
            Directory.CreateDirectory(Path.Combine(plugins, "vfit_data", "charts"));
            Directory.CreateDirectory(Path.Combine(player, "Game_Data", "Plugins"));
            File.WriteAllText(Path.Combine(plugins, "libvfit.so"), "");
            File.WriteAllText(Path.Combine(plugins, "vfit_data", "charts", "paper.json"), "{}");
            File.WriteAllText(Path.Combine(plugins, "vfit_data", "charts", "paper.json.meta"), "");
            Assert.AreEqual(0, Editor.PlayerFolders.Copy(Path.Combine(top, "Plugins"), player));
            File.WriteAllText(Path.Combine(player, "Game_Data", "Plugins", "libvfit.so"), "");
            Assert.AreEqual(1, Editor.PlayerFolders.Copy(Path.Combine(top, "Plugins"), player));
            string charts = Path.Combine(player, "Game_Data", "Plugins", "vfit_data", "charts");
            Assert.AreEqual(new[] { Path.Combine(charts, "paper.json") }, Directory.GetFiles(charts));
            Assert.AreEqual(0, Editor.PlayerFolders.Copy(Path.Combine(top, "missing"), player));
        }
    }
}
