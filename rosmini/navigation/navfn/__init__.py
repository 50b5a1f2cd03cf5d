"""navfn: a potential over the costmap, and a path that descends its gradient (http://wiki.ros.org/navfn)."""
