// A mirror on an empty object: makes the objects that a fitting room fills, shows the dressed person and says
// what they should do.
using UnityEngine;
using Vfit;
using Vfit.Unity;

public sealed class MirrorSample : MonoBehaviour
{
    public string sensor = "virtual:motion=demo&sex=f";
    public Material skin, fabric;

    private bool measured;

    public FittingRoom Room { get; private set; }

    private void Start()
    {
        // Off while it is set up: a component is enabled as soon as it is added to an active object.
        var owner = new GameObject("fitting room");
        owner.SetActive(false);
        owner.transform.SetParent(transform, false);
        Room = owner.AddComponent<FittingRoom>();
        Room.settings.sensor = sensor;
        Room.settings.mirror = true;
        Room.bodyMesh = Shown("body", skin, owner.transform);
        Room.clothMesh = Shown("cloth", fabric, owner.transform);
        owner.SetActive(true);
    }

    private void Update()
    {
        if (Room == null || measured || Room.State != FittingState.Following) return;
        measured = true;
        foreach (Measurement m in Room.Measure())
            Debug.Log(m.Key + " " + m.Value.ToString("0.000") + " +- " + m.Sigma.ToString("0.000"));
    }

    private void OnGUI()
    {
        if (Room == null) return;
        ScanState scan = Room.Scan;
        string frames = scan.FramesTaken + " of " + scan.FramesWanted;
        GUILayout.Label(Room.State + "  " + frames + "  " + scan.Guidance);
    }

    private static MeshFilter Shown(string name, Material material, Transform parent)
    {
        var child = new GameObject(name);
        child.transform.SetParent(parent, false);
        child.AddComponent<MeshRenderer>().sharedMaterial = material;
        return child.AddComponent<MeshFilter>();
    }
}
