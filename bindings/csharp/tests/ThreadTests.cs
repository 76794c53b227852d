// Two threads on one object, Dispose and finalizers in the middle of a call: the library stays whole.
using System;
using System.Threading;
using NUnit.Framework;

namespace Vfit.Tests
{
    [TestFixture]
    public class ThreadTests : ContextTest
    {
        [Test]
        public void TwoThreadsThatStepOneClothGetBusyOrAStep()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            using (var cloth = new Cloth(avatar, garment, new ClothDesc { Flags = ClothFlags.Awake }))
            {
                int steps = 0, busy = 0;
                Exception other = null;
                ThreadStart work = () =>
                {
                    for (int i = 0; i < 100; i++)
                        try
                        {
                            cloth.Step(1 / 60f);
                            Interlocked.Increment(ref steps);
                        }
                        catch (VfitException error)
                        {
                            if (error.Code == Result.ErrorBusy) Interlocked.Increment(ref busy);
                            else other = error;
                        }
                };
                Run(work, work);
                Assert.IsNull(other);
                Assert.AreEqual(200, steps + busy);
                Assert.Greater(steps, 0);
            }
        }

        [Test]
        public void TwoThreadsWithAnErrorEachReadTheirOwnSentence()
        {
            string wrong = null;
            Func<string, ThreadStart> ask = name => () =>
            {
                for (int i = 0; i < 300; i++)
                    try
                    {
                        SizeChart.Open(Context, name).Dispose();
                    }
                    catch (VfitException error)
                    {
                        if (!error.Message.Contains(name)) wrong = error.Message;
                    }
            };
            Run(ask("first_chart"), ask("second_chart"));
            Assert.IsNull(wrong);
        }

        [Test]
        public void DisposeWakesAThreadThatWaitsForAFrame()
        {
            var sensor = new Sensor(Context, "virtual:motion=scan&pace=realtime&rate=1&sensor=kinect_v1_320");
            sensor.Start();
            Exception caught = null;
            var frame = new Frame(Context);
            var waits = new Thread(() =>
            {
                try
                {
                    while (true) sensor.Acquire(frame, -1);
                }
                catch (Exception error)
                {
                    caught = error;
                }
            });
            waits.Start();
            Thread.Sleep(200);
            sensor.Dispose();
            Assert.IsTrue(waits.Join(10000), "still waiting");
            Assert.That(caught, Is.InstanceOf<VfitException>().Or.InstanceOf<ObjectDisposedException>());
        }

        [Test]
        public void AContextMayBeDisposedWhileAnotherThreadSteps()
        {
            for (int round = 0; round < 10; round++)
            {
                var context = new Context();
                Avatar avatar = Support.MakeAvatar(context);
                BodyPose pose = BodyPose.Rest(new Float3(0, 1, 0));
                Exception caught = null;
                var steps = new Thread(() =>
                {
                    try
                    {
                        while (true) avatar.Pose(pose);
                    }
                    catch (Exception error)
                    {
                        caught = error;
                    }
                });
                steps.Start();
                Thread.Sleep(round);
                context.Dispose();
                Assert.IsTrue(steps.Join(10000));
                Assert.AreEqual(Result.ErrorHandle, ((VfitException)caught).Code);
                avatar.Dispose();
            }
        }

        [Test]
        public void TwoThreadsDisposeOneObjectOnce()
        {
            for (int round = 0; round < 100; round++)
            {
                var motion = new Motion(Context);
                Run(motion.Dispose, motion.Dispose);
            }
            Assert.AreEqual(0u, Context.Stats().HandleCount);
        }

        /// <summary>While the collector runs, only the running call refers to avatar and context.</summary>
        [Test]
        public void AnObjectIsNotCollectedUnderItsOwnCall()
        {
            Exception caught = null;
            int steps = 0;
            bool stop = false;
            var stepping = new Thread(() =>
            {
                BodyPose pose = BodyPose.Rest(new Float3(0, 1, 0));
                try
                {
                    while (!Volatile.Read(ref stop))
                    {
                        Support.MakeAvatar(new Context()).Pose(pose);
                        steps++;
                    }
                }
                catch (Exception error)
                {
                    caught = error;
                }
            });
            stepping.Start();
            DateTime end = DateTime.UtcNow.AddSeconds(3);
            while (DateTime.UtcNow < end && stepping.IsAlive) ErrorTests.Collect();
            Volatile.Write(ref stop, true);
            Assert.IsTrue(stepping.Join(20000));
            Assert.IsNull(caught, caught == null ? "" : caught.ToString());
            Assert.Greater(steps, 3);
        }

        /// <summary>A garment refers to its context's handle only through its own handle.</summary>
        [Test]
        public void AChildKeepsItsContextAlive()
        {
            var garments = new Garment[10];
            for (int i = 0; i < garments.Length; i++)
            {
                int place = i;
                var thread = new Thread(() => garments[place] = Garment.Open(new Context(), "sundress"));
                thread.Start();
                thread.Join();
            }
            ErrorTests.Collect();
            foreach (Garment garment in garments)
            {
                Assert.AreEqual("sundress", garment.Describe().Name.ToLowerInvariant());
                garment.Dispose();
            }
        }

        [Test]
        public void FinalizersOfAbandonedObjectsRunWhileAnotherThreadSteps()
        {
            using (Avatar avatar = Support.MakeAvatar(Context))
            using (Garment garment = Garment.Open(Context, "sundress"))
            {
                bool stop = false;
                Exception caught = null;
                var kept = new Cloth(avatar, garment);
                var stepping = new Thread(() =>
                {
                    try
                    {
                        while (!Volatile.Read(ref stop)) kept.Step(1 / 60f);
                    }
                    catch (Exception error)
                    {
                        caught = error;
                    }
                });
                stepping.Start();
                for (int i = 0; i < 20; i++)
                {
                    Abandon(avatar, garment);
                    ErrorTests.Collect();
                }
                Volatile.Write(ref stop, true);
                stepping.Join();
                Assert.IsNull(caught, caught == null ? "" : caught.ToString());
                kept.Dispose();
                // Mono scans stacks conservatively: the last few may seem to be in use.
                Assert.Less(Context.Stats().HandleCount, 30u, "abandoned objects were given back");
            }
        }

        [Test]
        public void AnAbandonedSensorStopsByItsFinalizer()
        {
            for (int i = 0; i < 20; i++) StartAndForget();
            ErrorTests.Collect();
            // Mono scans stacks conservatively: the last few may seem to be in use.
            Assert.Less(Context.Stats().HandleCount, 10u);
        }

        private void StartAndForget()
        {
            const string uri = "virtual:pace=realtime&sensor=kinect_v1_320";
            var thread = new Thread(() => new Sensor(Context, uri).Start());
            thread.Start();
            thread.Join();
        }

        /// <summary>On a thread of its own, whose stack is gone afterwards.</summary>
        private static void Abandon(Avatar avatar, Garment garment)
        {
            var thread = new Thread(() =>
            {
                var frame = new Frame(avatar.Context);
                avatar.Acquire(frame);
                new Motion(avatar.Context).Bind(avatar);
                new Scan(avatar.Context).Reset();
            });
            thread.Start();
            thread.Join();
        }

        private static void Run(params ThreadStart[] work)
        {
            Thread[] threads = Array.ConvertAll(work, w => new Thread(w));
            foreach (Thread thread in threads) thread.Start();
            foreach (Thread thread in threads) Assert.IsTrue(thread.Join(60000), "hangs");
        }
    }
}
