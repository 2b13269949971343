// Runs floatref, reads its JSON, its exit code and the profile. .NET Framework 4.5 or later, .NET, Mono.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Runtime.Serialization;
using System.Runtime.Serialization.Json;
using System.Text;

[DataContract]
public class TrackReport
{
    [DataMember] public string name;
    [DataMember] public double? iri_m_per_km; // null where there is no IRI
    [DataMember] public double invalid_m;
}

[DataContract]
public class ProcessReport
{
    [DataMember] public string pipeline;
    [DataMember] public double interval_m;
    [DataMember] public double length_m;
    [DataMember] public List<TrackReport> tracks;
    [DataMember] public List<string> warnings;
}

public class FloatrefException : Exception
{
    public readonly int ExitCode;
    public FloatrefException(int code, string line) : base(line) { ExitCode = code; }
}

public static class Floatref
{
    // The last argument of a list must not end with a backslash; folders are given without one.
    public static string Run(string program, params string[] arguments)
    {
        var start = new ProcessStartInfo
        {
            FileName = program,
            Arguments = "\"" + string.Join("\" \"", arguments) + "\"",
            UseShellExecute = false,
            CreateNoWindow = true,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        // Messages in UTF-8 whatever the code page; JSON is ASCII in any case.
        start.EnvironmentVariables["PYTHONIOENCODING"] = "utf-8";
        start.StandardErrorEncoding = Encoding.UTF8;
        var errors = new StringBuilder();
        using (var process = new Process { StartInfo = start })
        {
            process.ErrorDataReceived += (_, line) => errors.AppendLine(line.Data);
            process.Start();
            process.BeginErrorReadLine();
            string output = process.StandardOutput.ReadToEnd();
            process.WaitForExit();
            if (process.ExitCode != 0)
                throw new FloatrefException(process.ExitCode, errors.ToString().Trim());
            return output;
        }
    }

    public static ProcessReport Process(string program, string recording, string profile)
    {
        string json = Run(program, "process", recording, "--out", profile, "--overwrite", "--json");
        var reader = new DataContractJsonSerializer(typeof(ProcessReport));
        using (var stream = new MemoryStream(Encoding.UTF8.GetBytes(json)))
            return (ProcessReport)reader.ReadObject(stream);
    }

    // Elevation in m, one per point; NaN was not measured. Files are little-endian float64.
    public static double[] ReadElevation(string profileDirectory, string track)
    {
        byte[] bytes = File.ReadAllBytes(Path.Combine(profileDirectory, track + ".f64"));
        var elevation = new double[bytes.Length / sizeof(double)];
        Buffer.BlockCopy(bytes, 0, elevation, 0, bytes.Length);
        return elevation;
    }
}

public static class Program
{
    public static int Main(string[] words)
    {
        if (words.Length != 3)
        {
            Console.Error.WriteLine("usage: RoadProfile FLOATREF RECORDING PROFILE");
            return 2;
        }
        try
        {
            ProcessReport report = Floatref.Process(words[0], words[1], words[2]);
            foreach (TrackReport track in report.tracks)
            {
                double[] elevation = Floatref.ReadElevation(words[2], track.name);
                Console.WriteLine(string.Format(
                    CultureInfo.InvariantCulture, "{0}: IRI {1:F3} m/km, {2:F1} m not valid, {3} points",
                    track.name, track.iri_m_per_km, track.invalid_m, elevation.Length));
            }
            return 0;
        }
        catch (FloatrefException error)
        {
            Console.Error.WriteLine(error.Message);
            return error.ExitCode;
        }
    }
}
