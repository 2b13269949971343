// Sends a table of samples to `floatref live`, and prints the final points.
//
//     mcs Client.cs && mono Client.exe PORT TABLE.csv RATE_HZ
//
// A row of the table is: specific force in m/s2, height in m, distance in m. Samples are numbered, so
// that a run which was killed is completed by the same call: what the command has is left out.

using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Net.Sockets;
using System.Text;
using System.Threading;

public static class Client
{
    const int AtOnce = 100;
    static readonly string[] Names = { "left.vertical_specific_force", "left.height", "distance" };

    static string Hello(string rate)
    {
        var channels = new[]
        {
            "{\"name\": \"vertical_specific_force\", \"track\": \"left\", \"unit\": \"m/s\u00b2\"",
            "{\"name\": \"height\", \"track\": \"left\", \"unit\": \"m\"",
            "{\"name\": \"distance\", \"unit\": \"m\"",
        };
        return "{\"kind\": \"hello\", \"format\": \"floatref-live/1\", "
            + "\"pipeline\": \"temporal-matched-hpf\", \"setup\": {\"profile_interval_m\": 0.1}, "
            + "\"channels\": ["
            + string.Join(", ", channels.Select(c => c + ", \"rate_hz\": " + rate + "}")) + "]}";
    }

    static string Samples(List<string[]> rows, long first)
    {
        var pieces = Names.Select((name, c) => "\"" + name + "\": {\"first\": " + first
            + ", \"values\": [" + string.Join(", ", rows.Select(row => row[c])) + "]}");
        return "{\"kind\": \"samples\", \"channels\": {" + string.Join(", ", pieces) + "}}";
    }

    static void Send(StreamWriter output, string table, string rate)
    {
        var rows = new List<string[]>();
        long first = 0;
        output.WriteLine(Hello(rate));
        foreach (var line in File.ReadLines(table))
        {
            rows.Add(line.Split(','));
            if (rows.Count < AtOnce) continue;
            output.WriteLine(Samples(rows, first));
            output.Flush(); // A logger sends each piece when it is measured.
            first += rows.Count;
            rows.Clear();
        }
        if (rows.Count > 0) output.WriteLine(Samples(rows, first));
        output.WriteLine("{\"kind\": \"finish\"}");
        output.Flush();
    }

    public static int Main(string[] given)
    {
        if (given.Length != 3)
        {
            Console.Error.WriteLine("usage: Client PORT TABLE.csv RATE_HZ");
            return 2;
        }
        using (var peer = new TcpClient("127.0.0.1", int.Parse(given[0])))
        {
            var stream = peer.GetStream();
            var output = new StreamWriter(stream, new UTF8Encoding(false)) { NewLine = "\n" };
            var input = new StreamReader(stream, new UTF8Encoding(false));
            var sender = new Thread(() => Send(output, given[1], given[2]));
            sender.Start();
            var code = 1;
            for (var line = input.ReadLine(); line != null; line = input.ReadLine())
            {
                if (line.StartsWith("{\"kind\": \"points\"") && line.Contains("\"state\": \"final\""))
                    Console.WriteLine(line);
                if (line.StartsWith("{\"kind\": \"refused\"")) Console.Error.WriteLine(line);
                if (line.StartsWith("{\"kind\": \"finished\"")) code = 0;
            }
            sender.Join();
            return code;
        }
    }
}
