// SPDX-License-Identifier: Apache-2.0
// Query VOLUME X Y Z: the cell of a position, its irradiance / pi on a surface that faces up, and the
// probes of the volume. Opens the volume from memory.
using System;
using System.Globalization;
using System.IO;
using System.Text;
using Tetralight;

/// <summary>An open volume, which `using` closes.</summary>
public sealed unsafe class Volume : IDisposable
{
    private tetralight_volume* volume;

    public Volume(byte[] bytes)
    {
        tetralight_volume* opened = null;
        tetralight_error error;
        fixed (byte* first = bytes)
        {
            Check(Native.tetralight_open_memory(first, (UIntPtr)bytes.Length, &opened, &error), &error);
        }
        volume = opened;
    }

    public tetralight_info Info()
    {
        tetralight_info info;
        tetralight_error error;
        Check(Native.tetralight_get_info(volume, &info, &error), &error);
        return info;
    }

    public tetralight_light Query(float x, float y, float z)
    {
        float* position = stackalloc float[3];
        position[0] = x;
        position[1] = y;
        position[2] = z;
        tetralight_light light;
        tetralight_error error;
        Check(Native.tetralight_query(volume, position, null, &light, &error), &error);
        return light;
    }

    public void Dispose()
    {
        Native.tetralight_close(volume);
        volume = null;
    }

    public static void Check(tetralight_status status, tetralight_error* error)
    {
        if (status == tetralight_status.TETRALIGHT_OK) return;
        int length = 0;
        while (error->message[length] != 0) ++length;
        throw new IOException(Encoding.UTF8.GetString(error->message, length));
    }
}

public static class Program
{
    private static float Number(string text)
    {
        return float.Parse(text, CultureInfo.InvariantCulture);
    }

    private static unsafe void Run(string[] arguments)
    {
        using (Volume volume = new Volume(File.ReadAllBytes(arguments[0])))
        {
            tetralight_light light =
                volume.Query(Number(arguments[1]), Number(arguments[2]), Number(arguments[3]));
            float* up = stackalloc float[3];
            up[0] = up[2] = 0.0f;
            up[1] = 1.0f;
            float* rgb = stackalloc float[3];
            tetralight_error error;
            Volume.Check(Native.tetralight_sample_sh9(light.packed, up, rgb, &error), &error);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0} {1:F6} {2:F6} {3:F6} {4}",
                                            light.cell, rgb[0], rgb[1], rgb[2],
                                            volume.Info().probe_count));
        }
    }

    public static int Main(string[] arguments)
    {
        if (arguments.Length != 4)
        {
            Console.Error.WriteLine("usage: Query VOLUME X Y Z");
            return 2;
        }
        try
        {
            Run(arguments);
            return 0;
        }
        catch (IOException failed)
        {
            Console.Error.WriteLine(failed.Message);
            return 1;
        }
    }
}
