// What a fitting room is set up with, in the inspector or by a script before it is enabled.
using System;
using UnityEngine;

namespace Vfit.Unity
{
    [Serializable]
    public sealed class FittingSettings
    {
        [Tooltip("recording:PATH, virtual:motion=demo&sex=f, or a camera of a plug-in")]
        public string sensor = "virtual:motion=demo&sex=f";
        [Tooltip("Play recordings and the virtual person in real time, not one frame per rendered frame")]
        public bool realtime = true;
        [Tooltip("Starts a recording over when it ends")]
        public bool loop = true;
        [Tooltip("Swaps left and right, as a mirror does")]
        public bool mirror;
        [Tooltip("Scans the person first; otherwise the default body of that sex follows at once")]
        public bool scan = true;
        public Sex sex = Sex.Unknown;
        [Tooltip("A garment of the data folder, or empty")]
        public string garment = "sundress";
        [Tooltip("A size of the garment, or empty: made to the body")]
        public string size = "";
        [Tooltip("Leaves skin out that the garment hides. Costs about a tenth of a second, once")]
        public bool hideSkin = true;
    }
}
