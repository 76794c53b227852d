// A program that ends in mid-stream and disposes nothing: the process must end by itself, without a word.
using System;
using Vfit;

static class LeftOpen
{
    private static Frame kept;

    static int Main(string[] arguments)
    {
        var context = new Context(new ContextOptions { Log = (level, line) => GC.Collect() });
        var sensor = new Sensor(context, "virtual:motion=demo&pace=realtime&rate=240&sensor=kinect_v1_320");
        sensor.Start();
        kept = new Frame(context);
        for (int i = 0; i < 3; i++) sensor.Acquire(kept, -1);
        new Motion(context).Step(kept, 1, kept.View(StreamKind.Depth).TimeNs);
        if (arguments.Length > 0) Environment.Exit(0);
        return 0;
    }
}
