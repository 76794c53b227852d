// The inspector of a fitting room: the sensors that can be opened, and how far the scan is.
using System;
using UnityEditor;
using UnityEngine;

namespace Vfit.Unity.Editor
{
    [CustomEditor(typeof(FittingRoom))]
    internal sealed class FittingRoomEditor : UnityEditor.Editor
    {
        private SensorInfo[] sensors = new SensorInfo[0];
        private string problem = "";

        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            var room = (FittingRoom)target;
            if (GUILayout.Button("List sensors")) ListSensors();
            foreach (SensorInfo sensor in sensors)
                if (GUILayout.Button(sensor.Name + "   " + sensor.Uri))
                {
                    Undo.RecordObject(room, "Choose sensor");
                    room.settings.sensor = sensor.Uri;
                    EditorUtility.SetDirty(room);
                }
            if (problem.Length > 0) EditorGUILayout.HelpBox(problem, MessageType.Error);
            if (Application.isPlaying) EditorGUILayout.HelpBox(Describe(room), MessageType.Info);
        }

        public override bool RequiresConstantRepaint()
        {
            return Application.isPlaying;
        }

        private static string Describe(FittingRoom room)
        {
            ScanState scan = room.Scan;
            string text = room.State + ", " + scan.FramesTaken + " of " + scan.FramesWanted + " frames";
            if (scan.Guidance != Guidance.None) text += ", " + scan.Guidance;
            return room.Error.Length > 0 ? text + "\n" + room.Error : text;
        }

        private void ListSensors()
        {
            problem = "";
            try
            {
                using (var context = new Context()) sensors = context.Sensors();
            }
            catch (DllNotFoundException)
            {
                problem = "The native library is not installed; see the package's documentation.";
            }
            catch (VfitException error)
            {
                problem = error.Message;
            }
        }
    }
}
