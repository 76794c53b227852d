// A domain of code is unloaded while its cameras run, as an editor does when scripts are compiled anew.
using System;
using System.Threading;
using NUnit.Framework;

namespace Vfit.Tests
{
    /// <summary>Runs inside of the domain that goes.</summary>
    public sealed class ReloadedCode : MarshalByRefObject
    {
        private Context context;
        private Sensor sensor;
        private int lines;

        /// <summary>Leaves a stream, a log callback and open objects behind.</summary>
        public long Leave()
        {
            AppDomain.CurrentDomain.DomainUnload += (sender, e) => Library.Shutdown();
            context = new Context(new ContextOptions { Log = (level, line) => lines++ });
            sensor = new Sensor(context, "virtual:motion=demo&pace=realtime&rate=120&sensor=kinect_v1_320");
            sensor.Start();
            var frame = new Frame(context);
            sensor.Acquire(frame, -1);
            new Tracker(context).Update(frame, frame);
            return frame.View(StreamKind.Depth).TimeNs + lines;
        }
    }

    [TestFixture]
    public class ReloadTests
    {
        [Test]
        public void ADomainGoesWithItsStreamsRunning()
        {
            for (int round = 0; round < 5; round++)
            {
                AppDomainSetup setup = AppDomain.CurrentDomain.SetupInformation;
                AppDomain domain = AppDomain.CreateDomain("scripts " + round, null, setup);
                var code = (ReloadedCode)domain.CreateInstanceAndUnwrap(
                    typeof(ReloadedCode).Assembly.FullName, typeof(ReloadedCode).FullName);
                Assert.Greater(code.Leave(), 0);
                Thread.Sleep(20 * round);
                AppDomain.Unload(domain);
            }
            using (var context = new Context()) Assert.AreEqual(0u, context.Stats().HandleCount);
        }

        [Test]
        public void ShutdownMakesAllThatIsLeftStale()
        {
            var context = new Context();
            var scan = new Scan(context);
            Library.Shutdown();
            Assert.AreEqual(Result.ErrorHandle, Support.CodeOf(() => scan.Reset()));
            scan.Dispose();
            context.Dispose();
            Library.Shutdown();
        }
    }
}
