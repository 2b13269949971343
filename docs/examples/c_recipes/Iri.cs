// The IRI of elevations in m, one per line, by P/Invoke: mono Iri.exe INTERVAL_M < FILE
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Runtime.InteropServices;

static class Iri
{
    [StructLayout(LayoutKind.Sequential)]
    struct Config
    {
        public double IntervalM, MovingAverageM, StartLengthM, SpeedKmh;
    }

    const string Library = "floatref";

    [DllImport(Library)] static extern IntPtr fr_status_text(int status);
    [DllImport(Library)] static extern UIntPtr fr_real_size();
    [DllImport(Library)] static extern Config fr_iri_defaults();
    [DllImport(Library)] static extern UIntPtr fr_iri_size(ref Config config);
    [DllImport(Library)] static extern int fr_iri_init(IntPtr memory, UIntPtr size, ref Config config, out IntPtr iri);
    [DllImport(Library)] static extern int fr_iri_push(IntPtr iri, double[] elevation, UIntPtr count, double[] trace, UIntPtr capacity, out UIntPtr written);
    [DllImport(Library)] static extern int fr_iri_finish(IntPtr iri, double[] trace, UIntPtr capacity, out UIntPtr written);
    [DllImport(Library)] static extern int fr_iri_value(IntPtr iri, out double mPerKm);

    static void Check(int status)
    {
        if (status != 0)
            throw new InvalidOperationException(Marshal.PtrToStringAnsi(fr_status_text(status)));
    }

    static double Of(double[] elevation, double intervalM)
    {
        Config config = fr_iri_defaults();
        config.IntervalM = intervalM;
        var trace = new double[elevation.Length];
        var room = (UIntPtr)(uint)elevation.Length;
        UIntPtr size = fr_iri_size(ref config), written;
        // Not in an array: the collector may move one, and the object lies in this memory.
        IntPtr memory = Marshal.AllocHGlobal((int)size.ToUInt32() + 8), iri;
        try
        {
            double mPerKm;
            Check(fr_iri_init(memory, size, ref config, out iri));
            Check(fr_iri_push(iri, elevation, room, trace, room, out written));
            Check(fr_iri_finish(iri, trace, room, out written));
            Check(fr_iri_value(iri, out mPerKm));
            return mPerKm;
        }
        finally
        {
            Marshal.FreeHGlobal(memory);
        }
    }

    static int Main(string[] arguments)
    {
        var elevation = new List<double>();
        for (string line; (line = Console.ReadLine()) != null;)
            elevation.Add(double.Parse(line, CultureInfo.InvariantCulture));
        try
        {
            if (fr_real_size().ToUInt32() != sizeof(double))
                throw new InvalidOperationException("the library is of single precision; build it without FR_FLOAT");
            double intervalM = double.Parse(arguments[0], CultureInfo.InvariantCulture);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "IRI {0:F3} m/km", Of(elevation.ToArray(), intervalM)));
            return 0;
        }
        catch (InvalidOperationException error)
        {
            Console.Error.WriteLine(error.Message);
            return 2;
        }
    }
}
