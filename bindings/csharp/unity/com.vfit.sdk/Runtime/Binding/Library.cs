// What needs no context: version, names, definitions, and the end of everything.
using System.Collections.Generic;

namespace Vfit
{
    public static unsafe class Library
    {
        /// <summary>Version of the library that was loaded, as "0.2.0".</summary>
        public static string Version
        {
            get
            {
                uint v = Native.vfit_version();
                return (v >> 22) + "." + (v >> 12 & 0x3FF) + "." + (v & 0xFFF);
            }
        }

        /// <summary>Instruction set and compiler.</summary>
        public static LibraryInfo Describe()
        {
            return Calls.LibraryDescribe();
        }

        /// <summary>
        /// Ends all contexts of the process and joins their threads, for a host that reloads its code. Their
        /// remaining objects in C# give ErrorHandle from then on.
        /// </summary>
        public static void Shutdown()
        {
            Calls.Shutdown();
        }

        /// <summary>"ERROR_STATE" and the like.</summary>
        public static string ResultName(Result result)
        {
            return Utf8Text.Read(Native.vfit_result_name(result), Utf8Text.Few);
        }

        /// <summary>"LEFT_ELBOW"</summary>
        public static string JointName(JointId joint)
        {
            return Calls.JointName(joint);
        }

        /// <summary>"leftUpperArm", as VRM has it</summary>
        public static string BoneName(BoneId bone)
        {
            return Calls.BoneName(bone);
        }

        /// <summary>-1 for the first bone, -2 for one that does not exist.</summary>
        public static int BoneParent(BoneId bone)
        {
            return Native.vfit_bone_parent(bone);
        }

        /// <summary>Key and one-line definition of every measure, for example "chest_girth_m".</summary>
        public static List<KeyValuePair<string, string>> Measures()
        {
            var measures = new List<KeyValuePair<string, string>>();
            for (uint i = 0; ; i++)
            {
                string key = Calls.MeasureKey(i);
                if (key.Length == 0) return measures;
                measures.Add(new KeyValuePair<string, string>(key, Calls.MeasureText(i)));
            }
        }
    }
}
