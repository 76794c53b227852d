// What an avatar is made from: a scan, measures, a shape, a file, a packet.
using System;

namespace Vfit
{
    public sealed unsafe partial class Avatar
    {
        /// <summary>The scanned person.</summary>
        public static Avatar FromScan(Scan scan, AvatarDesc desc = default(AvatarDesc))
        {
            ScanHandle source = Scan.Of(scan, "scan");
            var avatar = new Avatar(scan.Context);
            desc.StructSize = (uint)sizeof(AvatarDesc);
            Calls.AvatarCreateFromScan(scan.Context.Handle, &desc, source, avatar.Handle);
            return avatar;
        }

        /// <summary>The default body scaled to stature_m and, where given, shoulder_breadth_m.</summary>
        public static Avatar FromMeasures(
            Context context, Measurement[] measures, AvatarDesc desc = default(AvatarDesc))
        {
            Arrays.Check(measures, 0, "measures");
            var avatar = new Avatar(context);
            desc.StructSize = (uint)sizeof(AvatarDesc);
            fixed (Measurement* items = measures)
                Calls.AvatarCreate(
                    context.Handle, &desc, items, (uint)sizeof(Measurement), (uint)measures.Length,
                    avatar.Handle);
            return avatar;
        }

        /// <summary>A body of that shape; omitted keys keep the value of the default body.</summary>
        public static Avatar FromShape(
            Context context, ShapeValue[] shape, AvatarDesc desc = default(AvatarDesc))
        {
            Arrays.Check(shape, 0, "shape");
            var avatar = new Avatar(context);
            desc.StructSize = (uint)sizeof(AvatarDesc);
            fixed (ShapeValue* items = shape)
                Calls.AvatarCreateFromShape(
                    context.Handle, &desc, items, (uint)sizeof(ShapeValue), (uint)shape.Length,
                    avatar.Handle);
            return avatar;
        }

        /// <summary>
        /// A character from a glTF or VRM file; boneMap: null, or JSON of VRM bones and nodes.
        /// </summary>
        public static Avatar Load(
            Context context, string path, string boneMap = null, AvatarDesc desc = default(AvatarDesc))
        {
            var character = new CharacterDesc();
            fixed (byte* file = Utf8Text.Encode(path, "path"))
            {
                character.path = file;
                return Load(context, ref character, boneMap, ref desc);
            }
        }

        /// <summary>The same from the file's bytes.</summary>
        public static Avatar Load(
            Context context, byte[] file, string boneMap = null, AvatarDesc desc = default(AvatarDesc))
        {
            Arrays.Check(file, 0, "file");
            var character = new CharacterDesc();
            fixed (byte* bytes = file)
            {
                character.bytes = bytes;
                character.ByteCount = (ulong)file.LongLength;
                return Load(context, ref character, boneMap, ref desc);
            }
        }

        /// <summary>What Avatar.Pack made on another machine, and the size that came with it.</summary>
        public static Avatar Unpack(
            Context context, byte[] packet, out string sizeLabel, AvatarDesc desc = default(AvatarDesc))
        {
            Arrays.Check(packet, 0, "packet");
            var avatar = new Avatar(context);
            desc.StructSize = (uint)sizeof(AvatarDesc);
            const int capacity = 64;    // a label has at most 19 bytes
            byte* label = stackalloc byte[capacity];
            fixed (byte* bytes = packet)
                Calls.AvatarUnpack(
                    context.Handle, &desc, bytes, (uint)packet.Length, label, capacity, avatar.Handle);
            sizeLabel = Utf8Text.Read(label, capacity);
            return avatar;
        }

        private static Avatar Load(
            Context context, ref CharacterDesc character, string boneMap, ref AvatarDesc desc)
        {
            var avatar = new Avatar(context);
            fixed (byte* map = Utf8Text.Encode(boneMap))
            fixed (CharacterDesc* source = &character)
            fixed (AvatarDesc* settings = &desc)
            {
                source->StructSize = (uint)sizeof(CharacterDesc);
                source->boneMap = map;
                settings->StructSize = (uint)sizeof(AvatarDesc);
                Calls.AvatarLoad(context.Handle, settings, source, avatar.Handle);
            }
            return avatar;
        }
    }
}
