// Cloth: a garment on an avatar, stepped once a rendered frame.
using System;
using System.Collections.Generic;

namespace Vfit
{
    public sealed unsafe class Cloth : VfitObject<ClothHandle>
    {
        public Avatar Avatar { get; private set; }

        /// <summary>The cloth below this one, or null; the reference keeps it from collection.</summary>
        public Cloth Inner { get; private set; }

        private readonly HashSet<Prop> props = new HashSet<Prop>();  // kept from collection

        /// <summary>sizeLabel: null is made to the avatar.</summary>
        public Cloth(
            Avatar avatar, Garment garment, ClothDesc desc = default(ClothDesc), string sizeLabel = null)
            : base(new ClothHandle(Avatar.Of(avatar, "avatar")))
        {
            Avatar = avatar;
            fixed (byte* label = Utf8Text.Encode(sizeLabel))
            {
                desc.StructSize = (uint)sizeof(ClothDesc);
                desc.sizeLabel = label;
                Calls.ClothCreate(avatar.Handle, Garment.Of(garment, "garment"), &desc, Handle);
            }
        }

        /// <summary>Put on anew, so that limbs push it aside. Takes as long as some 35 steps.</summary>
        public void Reset()
        {
            Calls.ClothReset(Handle);
        }

        /// <summary>Pose the avatar first.</summary>
        public void Step(float dt)
        {
            Calls.ClothStep(Handle, dt);
        }

        /// <summary>Hands the step to a worker; EndStep waits for it.</summary>
        public void BeginStep(float dt)
        {
            Calls.ClothBeginStep(Handle, dt);
        }

        public void EndStep()
        {
            Calls.ClothEndStep(Handle);
        }

        /// <summary>
        /// Between steps: moves the last step's cloth into the avatar's current pose, for Acquire. Does not
        /// wait for a step that runs.
        /// </summary>
        public void Carry()
        {
            Calls.ClothCarry(Handle);
        }

        /// <summary>Another size of the garment, from how it hangs now; null: made to the avatar.</summary>
        public void SetSize(string sizeLabel)
        {
            fixed (byte* label = Utf8Text.Encode(sizeLabel)) Calls.ClothSetSize(Handle, label);
        }

        /// <summary>How it sits, by girths of the trunk: let it come to rest first.</summary>
        public FitZone[] Fit()
        {
            return Calls.ClothFit(Handle);
        }

        /// <summary>One value a vertex of what Acquire gives: above 0 tight, below 0 loose.</summary>
        public void FitMap(float[] values)
        {
            Arrays.Check(values, 0, "values");
            fixed (float* to = values) Calls.ClothFitMap(Handle, to, (uint)values.Length);
        }

        /// <summary>
        /// The avatar's pose at the next step is a jump from the last one: the bones carry the cloth along,
        /// and it feels none of the way.
        /// </summary>
        public void Teleport()
        {
            Calls.ClothTeleport(Handle);
        }

        /// <summary>Velocity of the air in the context's axes.</summary>
        public void SetWind(Float3 wind)
        {
            Calls.ClothSetWind(Handle, &wind.X);
        }

        public void SetQuality(int substeps, float budgetMs)
        {
            if (substeps < 0) throw new ArgumentOutOfRangeException("substeps");
            Calls.ClothSetQuality(Handle, (uint)substeps, budgetMs);
        }

        /// <summary>
        /// Puts this on over inner: from now on the two push each other and do not cross. The first one that
        /// is stepped in a frame steps both; the step of the other then finds its own done.
        /// </summary>
        public void WearOver(Cloth inner)
        {
            Calls.ClothWearOver(Handle, Of(inner, "inner"));
            Inner = inner;
        }

        /// <summary>Stays outside of that prop from the next step on.</summary>
        public void AddProp(Prop prop)
        {
            Calls.ClothAddProp(Handle, Prop.Of(prop, "prop"));
            props.Add(prop);
        }

        public void RemoveProp(Prop prop)
        {
            Calls.ClothRemoveProp(Handle, Prop.Of(prop, "prop"));
            props.Remove(prop);
        }

        /// <summary>
        /// Tests the last finished steps of an outfit, 1 to 64 cloths of one avatar, for triangles that
        /// cross: of a garment with itself, with the skin, with another one, with a prop. Empty: none do.
        /// </summary>
        public static Crossing[] CheckOutfit(params Cloth[] cloths)
        {
            if (cloths == null) throw new ArgumentNullException("cloths");
            int counted = Math.Min(cloths.Length, 64);
            const int props = 64;  // of a cloth, at most
            // One for each pair of surfaces.
            var found = new Crossing[counted * (counted + 3) / 2 + counted * props];
            ClothId* ids = stackalloc ClothId[MaxCloths];
            bool* held = stackalloc bool[MaxCloths];
            try
            {
                Hold(cloths, ids, held);
                Array.Resize(ref found, Calls.OutfitCheck(ids, (uint)cloths.Length, found));
            }
            finally
            {
                Release(cloths, held);
            }
            return found;
        }

        /// <summary>
        /// The avatar's mesh to draw below an outfit, 1 to 64 cloths of one avatar, as they are shown: skin
        /// gives way where it would come through a garment.
        /// </summary>
        /// <returns>Pairs of triangles that still cross; 0: none do.</returns>
        public static uint AcquireSkin(Frame into, params Cloth[] cloths)
        {
            if (cloths == null) throw new ArgumentNullException("cloths");
            ClothId* ids = stackalloc ClothId[MaxCloths];
            bool* held = stackalloc bool[MaxCloths];
            try
            {
                Hold(cloths, ids, held);
                uint crossing;
                Calls.OutfitSkin(ids, (uint)cloths.Length, Frame.Of(into, "into"), &crossing);
                return crossing;
            }
            finally
            {
                Release(cloths, held);
            }
        }

        // Cloths that the library refuses to look at are not held.
        const int MaxCloths = 64;

        static void Hold(Cloth[] cloths, ClothId* ids, bool* held)
        {
            for (int i = 0; i < Math.Min(cloths.Length, MaxCloths); i++) held[i] = false;
            for (int i = 0; i < Math.Min(cloths.Length, MaxCloths); i++)
                ids[i] = new ClothId(VfitHandle.Hold(Of(cloths[i], "cloths"), ref held[i]));
        }

        static void Release(Cloth[] cloths, bool* held)
        {
            for (int i = 0; i < Math.Min(cloths.Length, MaxCloths); i++)
                if (held[i]) cloths[i].Handle.DangerousRelease();
        }

        /// <summary>
        /// Sets the bytes of the avatar's triangles that this garment hides to 1 and leaves the others as
        /// they are, so that garments add up. One byte per triangle. Cost: about 100 steps.
        /// </summary>
        public void HideSkin(byte[] triangles, float marginM = 0)
        {
            Arrays.Check(triangles, 0, "triangles");
            fixed (byte* bytes = triangles)
                Calls.ClothHideSkin(Handle, marginM, bytes, (uint)triangles.Length);
        }

        /// <summary>Positions, normals, uv, indices, strain and, where asked for, pressure.</summary>
        public void Acquire(Frame into)
        {
            Calls.ClothAcquire(Handle, Frame.Of(into, "into"));
        }

        public ClothStats Stats()
        {
            return Calls.ClothDescribe(Handle);
        }

        public ulong StateHash()
        {
            ulong hash;
            Calls.ClothStateHash(Handle, &hash);
            return hash;
        }
    }
}
