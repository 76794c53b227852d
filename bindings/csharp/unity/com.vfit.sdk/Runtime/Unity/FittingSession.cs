// One run of a fitting room, without anything of the scene: sensor, tracker, scan, motion, avatar, cloth.
using System;
using UnityEngine;

namespace Vfit.Unity
{
    /// <summary>
    /// Call Begin and End once per rendered frame; between them a worker steps the cloth. Once the avatar
    /// follows the person, neither makes garbage.
    /// </summary>
    public sealed class FittingSession : IDisposable
    {
        private readonly FittingSettings settings;
        private readonly Context context;
        private readonly Frame frame, tracked;
        private readonly Tracker tracker;
        private readonly Motion motion;
        private readonly Scan scan;
        private Sensor sensor;
        private Avatar avatar;
        private Cloth cloth;
        private byte[] hiddenSkin;
        private bool stepping;

        public readonly BodyPose Pose = new BodyPose();
        public readonly Frame BodyFrame, ClothFrame;

        public FittingState State { get; private set; }
        public ScanState ScanState { get; private set; }
        public bool HasPose { get; private set; }

        public bool HasAvatar
        {
            get { return avatar != null && !BodyFrame.IsEmpty; }
        }

        public bool HasCloth
        {
            get { return cloth != null && !ClothFrame.IsEmpty; }
        }

        public FittingSession(FittingSettings settings)
        {
            this.settings = settings;
            context = new Context(new ContextOptions
            {
                Axes = Axes.Unity,
                Flags = settings.mirror ? ContextFlags.Mirror : ContextFlags.None
            });
            try
            {
                frame = new Frame(context);
                tracked = new Frame(context);
                BodyFrame = new Frame(context);
                ClothFrame = new Frame(context);
                tracker = new Tracker(context);
                motion = new Motion(context);
                if (settings.scan) scan = new Scan(context, new ScanDesc { Sex = settings.sex });
                else Dress(Avatar.FromShape(context, new ShapeValue[0], BodyDesc()));
                Open();
                State = FittingState.Waiting;
            }
            catch
            {
                context.Dispose();
                throw;
            }
        }

        /// <summary>Takes the newest frame, poses the avatar and begins the step of its cloth.</summary>
        public void Begin(float dt)
        {
            ForwardLog();
            Result news = sensor.Acquire(frame, 0);
            bool isNew = news == Result.Ok;
            if (isNew)
            {
                tracker.Update(frame, tracked);
                frame.Clear();
                if (avatar == null) AddToScan();
            }
            else if (news == Result.EndOfStream)
            {
                if (settings.loop) Open();
                else State = FittingState.Ended;
            }
            if (tracked.IsEmpty) return;

            uint person = tracked.ActiveBody();
            if (person != 0 && State == FittingState.Waiting) State = FittingState.Scanning;
            // Without a new frame motion predicts to now: a camera of 30 frames drives a screen of 144.
            long now = settings.realtime ? context.TimeNs : tracked.View(StreamKind.Depth).TimeNs;
            if (State == FittingState.Ended) return;
            if (motion.Step(isNew ? tracked : null, person, now) != Result.Ok) return;
            motion.Pose(Pose);
            HasPose = true;
            if (avatar == null) return;
            State = FittingState.Following;
            avatar.Pose(Pose);
            if (cloth == null) return;
            cloth.BeginStep(dt);
            stepping = true;
        }

        /// <summary>Waits for the cloth and takes the meshes of this frame.</summary>
        public void End()
        {
            if (stepping)
            {
                stepping = false;
                cloth.EndStep();
                cloth.Acquire(ClothFrame);
            }
            if (avatar != null && HasPose) avatar.Acquire(BodyFrame);
        }

        /// <summary>One byte a triangle of the body, 1 where the garment hides it: once, then null.</summary>
        public byte[] TakeHiddenSkin()
        {
            byte[] hidden = hiddenSkin;
            hiddenSkin = null;
            return hidden;
        }

        public Measurement[] Measure()
        {
            return scan != null && ScanState.FramesTaken > 0 ? scan.Measure() : new Measurement[0];
        }

        /// <summary>Ends everything in the context, also a step that was begun.</summary>
        public void Dispose()
        {
            context.Dispose();
        }

        private void Open()
        {
            if (sensor != null) sensor.Dispose();
            sensor = new Sensor(context, settings.sensor);
            if (settings.realtime) sensor.SetOption("pace", "realtime");
            tracker.Reset();
            motion.Reset();
            HasPose = false;
            tracked.Clear();
            sensor.Start();
        }

        private void AddToScan()
        {
            ScanState state;
            if (scan.Add(tracked, out state) == Result.Ok) Dress(Avatar.FromScan(scan, BodyDesc()));
            ScanState = state;
        }

        private void Dress(Avatar made)
        {
            avatar = made;
            motion.Bind(avatar);
            if (string.IsNullOrEmpty(settings.garment)) return;
            string size = string.IsNullOrEmpty(settings.size) ? null : settings.size;
            using (Garment garment = Garment.Open(context, settings.garment))
                cloth = new Cloth(avatar, garment, default(ClothDesc), size);
            if (!settings.hideSkin) return;
            hiddenSkin = new byte[avatar.Describe().IndexCount / 3];
            cloth.HideSkin(hiddenSkin);
        }

        private AvatarDesc BodyDesc()
        {
            return new AvatarDesc { Sex = settings.sex };
        }

        /// <summary>Polled, as a callback of a script that is being reloaded must not be called.</summary>
        private void ForwardLog()
        {
            LogLevel level;
            string line;
            while (context.NextLog(out level, out line))
                if (level == LogLevel.Error) Debug.LogError("vfit: " + line);
                else if (level == LogLevel.Warning) Debug.LogWarning("vfit: " + line);
                else Debug.Log("vfit: " + line);
        }
    }
}
