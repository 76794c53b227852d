// How the measures of people go together: from those that a person knows to all the others.
using System;

namespace Vfit
{
    public sealed unsafe class Population : VfitObject<PopulationHandle>
    {
        private Population(Context context) : base(new PopulationHandle(Context.Of(context, "context"))) { }

        /// <summary>Names of the populations in the data folder.</summary>
        public static DataName[] List(Context context)
        {
            return Calls.PopulationList(context.Handle);
        }

        /// <summary>A population of the data folder, by name: "adults".</summary>
        public static Population Open(Context context, string name)
        {
            byte[] text = Utf8Text.Encode(name, "name");
            var population = new Population(context);
            fixed (byte* bytes = text) Calls.PopulationOpen(context.Handle, bytes, population.Handle);
            return population;
        }

        /// <summary>A population as JSON (docs/measuring.md).</summary>
        public static Population Load(Context context, string json)
        {
            byte[] text = Utf8Text.Encode(json, "json");
            var population = new Population(context);
            fixed (byte* bytes = text)
                Calls.PopulationLoad(context.Handle, bytes, (ulong)text.Length - 1, population.Handle);
            return population;
        }

        /// <summary>Every measure of a person of whom these are known. Age 0: not told.</summary>
        public Measurement[] Estimate(Measurement[] known, Sex sex = Sex.Unknown, float ageYears = 0.0f)
        {
            Arrays.Check(known, 0, "known");
            Person person = PersonOf(sex, ageYears);
            fixed (Measurement* items = known)
                return Calls.PopulationEstimate(
                    Handle, &person, items, (uint)sizeof(Measurement), (uint)known.Length);
        }

        /// <summary>Measures that do not go with the others, the worst first.</summary>
        public Doubt[] Check(Measurement[] known, Sex sex = Sex.Unknown, float ageYears = 0.0f)
        {
            Arrays.Check(known, 0, "known");
            Person person = PersonOf(sex, ageYears);
            fixed (Measurement* items = known)
                return Calls.PopulationCheck(
                    Handle, &person, items, (uint)sizeof(Measurement), (uint)known.Length);
        }

        private static Person PersonOf(Sex sex, float ageYears)
        {
            return new Person { StructSize = (uint)sizeof(Person), Sex = sex, AgeYears = ageYears };
        }
    }
}
