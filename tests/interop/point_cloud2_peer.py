"""A script for sensor_msgs.point_cloud2: clouds of all kinds, and what is read of them.

Run by the real one and by ours.
"""

import json
import math
import random

import sensor_msgs.point_cloud2 as pc2
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

dice = random.Random(11)
facts = {"read": [], "made": []}
SIZES = dict(enumerate((1, 1, 2, 2, 4, 4, 4, 8), 1))


def plain(points):
    return [[repr(value) for value in point] for point in points]


for _ in range(60):
    fields, offset = [], 0
    for number in range(dice.randint(1, 6)):
        offset += dice.choice([0, 0, 1, 4])
        kind, count = dice.randint(1, 8), dice.choice([1, 1, 1, 2, 3])
        fields.append(PointField(f"f{number}", offset, kind, count))
        offset += count * SIZES[kind]
    step = offset + dice.choice([0, 0, 2, 8])
    width, height = dice.randint(0, 4), dice.randint(1, 3)
    row = width * step + dice.choice([0, 0, 5])
    data = bytearray(dice.randrange(256) for _ in range(row * height))
    dice.shuffle(fields)
    cloud = PointCloud2(
        fields=fields,
        width=width,
        height=height,
        point_step=step,
        row_step=row,
        data=bytes(data),
        is_bigendian=dice.random() < 0.3,
    )
    names = [field.name for field in fields]
    some = dice.sample(names, dice.randint(1, len(names)))
    uvs = [(dice.randrange(width), dice.randrange(height)) for _ in range(3)] if width else []
    facts["read"].append(
        [
            plain(pc2.read_points(cloud)),
            plain(pc2.read_points(cloud, some, skip_nans=True)),
            plain(pc2.read_points(cloud, some, uvs=uvs)),
        ]
    )
    if all(field.count == 1 for field in fields):
        facts["read"][-1].append([repr(point) for point in pc2.read_points_list(cloud, some)])

header = Header(frame_id="camera")
cloud = pc2.create_cloud_xyz32(header, [(1, 2.5, -3), [math.nan, 0, math.inf], (0.1, 1e30, 7)])
fields = [PointField("x", 0, 7, 1), PointField("rgb", 8, 6, 1), PointField("ring", 12, 2, 2)]
other = pc2.create_cloud(header, fields, [(1.5, 0xFF00FF, 3, 4), (2, 7, 5, 6)])
empty = pc2.create_cloud_xyz32(header, [])
for one in (cloud, other, empty):
    facts["made"].append(
        [
            [[field.name, field.offset, field.datatype, field.count] for field in one.fields],
            [one.width, one.height, one.point_step, one.row_step, one.is_dense, one.is_bigendian],
            one.header.frame_id,
            list(bytearray(one.data)),
            plain(pc2.read_points(one)),
            plain(pc2.read_points(one, skip_nans=True)),
        ]
    )
print(json.dumps(facts))
