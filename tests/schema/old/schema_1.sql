-- A database that gyrocal wrote before schema 2: one board of a campaign of 25 setpoints, two samples a
-- dwell. Made by sqlite3's .dump; never to be remade.
PRAGMA foreign_keys=OFF;
BEGIN TRANSACTION;
CREATE TABLE campaign (  -- one run of a plan over a set of boards
  id                   INTEGER PRIMARY KEY,
  name                 TEXT NOT NULL CHECK (name <> ''),  -- as in the campaign file
  config_toml          TEXT NOT NULL,  -- the campaign file as read
  software_version     TEXT NOT NULL,  -- of gyrocal when the campaign began
  utc_start_ns         INTEGER NOT NULL,  -- when t_ns was 0: nanoseconds since 1970 in UTC; 0: unknown, an imported session
  simulated            INTEGER NOT NULL CHECK (simulated IN (0, 1)),  -- 1: no real chamber, no real boards
  time_scale           REAL NOT NULL CHECK (time_scale > 0 AND time_scale < 1e6 AND (time_scale = 1 OR simulated = 1)),  -- campaign seconds a wall second
  samples_per_setpoint INTEGER NOT NULL CHECK (samples_per_setpoint >= 1),  -- asked of each dwell
  sample_rate_hz       REAL NOT NULL CHECK (sample_rate_hz > 0 AND sample_rate_hz < 1e9),  -- asked of the boards
  monitor_interval_s   REAL NOT NULL CHECK (monitor_interval_s > 0 AND monitor_interval_s < 1e6),  -- spacing of the rows in monitor
  state                TEXT NOT NULL CHECK (state IN ('preflight', 'ramping', 'soaking', 'logging', 'returning', 'analysing', 'finished', 'paused', 'holding', 'safe', 'aborted'))  -- where it stands; over when finished or aborted
) STRICT;
INSERT INTO campaign VALUES(1,'demo','[campaign]','0.1.0',1767225600360000000,1,400.0,3000,50.0,5.0,'finished');
CREATE TABLE board (  -- a gyro board in one campaign
  id                  INTEGER PRIMARY KEY,
  campaign_id         INTEGER NOT NULL REFERENCES campaign(id),  -- the campaign it took part in
  name                TEXT NOT NULL CHECK (name <> ''),  -- as in the campaign file
  device              TEXT NOT NULL,  -- the serial link it was reached by, or the session it came from
  mcu_id              TEXT NOT NULL,  -- unique id of its microcontroller, empty if unknown
  firmware_version    TEXT NOT NULL,  -- as the board answered
  hardware_version    TEXT NOT NULL,  -- as the board answered
  axes                TEXT NOT NULL CHECK (axes IN ('xyz', 'xy', 'xz', 'yz', 'x', 'y', 'z')),  -- those measured
  lsb_per_dps_x       REAL NOT NULL CHECK (lsb_per_dps_x > 0 AND lsb_per_dps_x < 1e9),  -- scale factor of X at 20 degC
  lsb_per_dps_y       REAL NOT NULL CHECK (lsb_per_dps_y > 0 AND lsb_per_dps_y < 1e9),  -- scale factor of Y at 20 degC
  lsb_per_dps_z       REAL NOT NULL CHECK (lsb_per_dps_z > 0 AND lsb_per_dps_z < 1e9),  -- scale factor of Z at 20 degC
  lsb_per_dps_per_k_x REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_x) < 1e6),  -- its change per kelvin, X
  lsb_per_dps_per_k_y REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_y) < 1e6),  -- its change per kelvin, Y
  lsb_per_dps_per_k_z REAL NOT NULL CHECK (abs(lsb_per_dps_per_k_z) < 1e6),  -- its change per kelvin, Z
  UNIQUE (campaign_id, name),
  UNIQUE (campaign_id, id)
) STRICT;
INSERT INTO board VALUES(1,1,'board0','/tmp/gyrocal-demo/board0','30ffd8054752323751160000','iNEMO Firmware_Version_2.2','iNEMO V2 Hardware_Version_1','xyz',4.1299999999999998934,4.1299999999999998934,4.1299999999999998934,0.0,0.0,0.0);
CREATE TABLE setpoint (  -- the plan: chamber temperatures in the order they are visited
  campaign_id INTEGER NOT NULL REFERENCES campaign(id),  -- whose plan
  ordinal     INTEGER NOT NULL CHECK (ordinal >= 0),  -- 0 is visited first
  setpoint_c  REAL NOT NULL CHECK (setpoint_c BETWEEN -273.15 AND 1000),  -- what the chamber is told
  PRIMARY KEY (campaign_id, ordinal)
) STRICT, WITHOUT ROWID;
INSERT INTO setpoint VALUES(1,0,-10.0);
INSERT INTO setpoint VALUES(1,1,-7.0);
INSERT INTO setpoint VALUES(1,2,-5.0);
INSERT INTO setpoint VALUES(1,3,-2.0);
INSERT INTO setpoint VALUES(1,4,0.0);
INSERT INTO setpoint VALUES(1,5,3.0);
INSERT INTO setpoint VALUES(1,6,5.0);
INSERT INTO setpoint VALUES(1,7,8.0);
INSERT INTO setpoint VALUES(1,8,10.0);
INSERT INTO setpoint VALUES(1,9,13.0);
INSERT INTO setpoint VALUES(1,10,15.0);
INSERT INTO setpoint VALUES(1,11,18.0);
INSERT INTO setpoint VALUES(1,12,20.0);
INSERT INTO setpoint VALUES(1,13,23.0);
INSERT INTO setpoint VALUES(1,14,25.0);
INSERT INTO setpoint VALUES(1,15,28.0);
INSERT INTO setpoint VALUES(1,16,30.0);
INSERT INTO setpoint VALUES(1,17,33.0);
INSERT INTO setpoint VALUES(1,18,35.0);
INSERT INTO setpoint VALUES(1,19,38.0);
INSERT INTO setpoint VALUES(1,20,40.0);
INSERT INTO setpoint VALUES(1,21,43.0);
INSERT INTO setpoint VALUES(1,22,45.0);
INSERT INTO setpoint VALUES(1,23,48.0);
INSERT INTO setpoint VALUES(1,24,50.0);
CREATE TABLE dwell (  -- one board at one setpoint, one attempt
  id                     INTEGER PRIMARY KEY,
  campaign_id            INTEGER NOT NULL,  -- the campaign of board and setpoint
  board_id               INTEGER NOT NULL,  -- which board
  ordinal                INTEGER NOT NULL,  -- which setpoint
  attempt                INTEGER NOT NULL CHECK (attempt >= 1),  -- 1 is the first
  t_start_ns             INTEGER NOT NULL,  -- logging began
  t_end_ns               INTEGER NOT NULL CHECK (t_end_ns >= t_start_ns),  -- logging ended
  soak_s                 REAL CHECK (soak_s BETWEEN 0 AND 1e9),  -- in the band before logging
  timed_soak             INTEGER NOT NULL CHECK (timed_soak IN (0, 1)),  -- 1: by the clock, the board's sensor being too coarse for the asked slope
  chamber_mean_c         REAL CHECK (chamber_mean_c BETWEEN -273.15 AND 1000),  -- air while logging
  chamber_peak_to_peak_k REAL CHECK (chamber_peak_to_peak_k BETWEEN 0 AND 1000),  -- max - min of the air while logging
  board_mean_c           REAL CHECK (board_mean_c BETWEEN -273.15 AND 1000),  -- the board's own sensor while logging
  samples                INTEGER NOT NULL CHECK (samples >= 0),  -- its rows in sample
  frames_missing         INTEGER NOT NULL CHECK (frames_missing >= 0),  -- sent by the board, never received
  counter_first          INTEGER NOT NULL CHECK (counter_first >= 0),  -- frame counter of the sample with seq 0
  reject_reason          TEXT CHECK (reject_reason <> ''),  -- NULL: accepted
  UNIQUE (board_id, ordinal, attempt),
  FOREIGN KEY (campaign_id, board_id) REFERENCES board(campaign_id, id),
  FOREIGN KEY (campaign_id, ordinal) REFERENCES setpoint(campaign_id, ordinal)
) STRICT;
INSERT INTO dwell VALUES(1,1,1,0,1,3370000000000,3429980000000,570.0,1,-9.9187033913145867813,0.10175037384033203125,-9.8311666666666663871,2,0,168514,NULL);
INSERT INTO dwell VALUES(3,1,1,1,1,4210000000000,4269980000000,545.0,1,-6.9187336349372818844,0.101779937744140625,-7.0,2,0,210514,NULL);
INSERT INTO dwell VALUES(5,1,1,2,1,4845000000000,4904980000000,445.0,1,-5.0901371675213402667,0.096625804901123046875,-5.0,2,0,242264,NULL);
INSERT INTO dwell VALUES(7,1,1,3,1,5680000000000,5739980000000,595.0,1,-2.0812884714491328708,0.1017589569091796875,-2.0,2,0,284014,NULL);
INSERT INTO dwell VALUES(9,1,1,4,1,6305000000000,6364980000000,430.0,1,0.071939996056681013159,0.10636582132428884506,-0.41883333333333333525,2,0,315264,NULL);
INSERT INTO dwell VALUES(11,1,1,5,1,7150000000000,7209980000000,550.0,1,3.0812671995676526037,0.10177922248840332031,3.0,2,0,357514,NULL);
INSERT INTO dwell VALUES(13,1,1,6,1,7785000000000,7844980000000,445.0,1,4.9098628324786597332,0.096625804901123046875,5.0,2,0,389264,NULL);
INSERT INTO dwell VALUES(15,1,1,7,1,8620000000000,8679980000000,595.0,1,7.9187114986592659349,0.1017589569091796875,8.0,2,0,431014,NULL);
INSERT INTO dwell VALUES(17,1,1,8,1,9245000000000,9304980000000,430.0,1,10.071939855718023082,0.106365203857421875,9.5811666666666663871,2,0,462264,NULL);
INSERT INTO dwell VALUES(19,1,1,9,1,10090000000000,10149980000000,550.0,1,13.081267159897311813,0.10177898406982421875,13.0,2,0,504514,NULL);
INSERT INTO dwell VALUES(21,1,1,10,1,10725000000000,10784980000000,445.0,1,14.909862733263457457,0.09662628173828125,15.0,2,0,536264,NULL);
INSERT INTO dwell VALUES(23,1,1,11,1,11560000000000,11619980000000,595.0,1,17.918711498976627183,0.1017589569091796875,18.0,2,0,578014,NULL);
INSERT INTO dwell VALUES(25,1,1,12,1,12185000000000,12244980000000,430.0,1,20.071940054783784291,0.106365203857421875,19.581166666666668163,2,0,609264,NULL);
INSERT INTO dwell VALUES(27,1,1,13,1,13030000000000,13089980000000,550.0,1,23.081267120147632709,0.101779937744140625,23.0,2,0,651514,NULL);
INSERT INTO dwell VALUES(29,1,1,14,1,13665000000000,13724980000000,445.0,1,24.909862773012498848,0.09662628173828125,25.0,2,0,683264,NULL);
INSERT INTO dwell VALUES(31,1,1,15,1,14500000000000,14559980000000,595.0,1,27.918711498976623631,0.1017589569091796875,28.0,2,0,725014,NULL);
INSERT INTO dwell VALUES(33,1,1,16,1,15125000000000,15184980000000,430.0,1,30.071940054783784291,0.106365203857421875,29.581166666666668164,2,0,756264,NULL);
INSERT INTO dwell VALUES(35,1,1,17,1,15970000000000,16029980000000,550.0,1,33.081266961148912742,0.101779937744140625,33.0,2,0,798514,NULL);
INSERT INTO dwell VALUES(37,1,1,18,1,16605000000000,16664980000000,445.0,1,34.909862533879703506,0.09662628173828125,35.0,2,0,830264,NULL);
INSERT INTO dwell VALUES(39,1,1,19,1,17440000000000,17499980000000,595.0,1,37.918711418843820126,0.1017608642578125,38.0,2,0,872014,NULL);
INSERT INTO dwell VALUES(41,1,1,20,1,18065000000000,18124980000000,430.0,1,40.071940054783787843,0.106365203857421875,39.581166666666668164,2,0,903264,NULL);
INSERT INTO dwell VALUES(43,1,1,21,1,18910000000000,18969980000000,550.0,1,43.081266961148912742,0.101779937744140625,43.0,2,0,945514,NULL);
INSERT INTO dwell VALUES(45,1,1,22,1,19545000000000,19604980000000,445.0,1,44.9098625338796964,0.09662628173828125,45.0,2,0,977264,NULL);
INSERT INTO dwell VALUES(47,1,1,23,1,20380000000000,20439980000000,595.0,1,47.918711418843813023,0.1017608642578125,48.0,2,0,1019014,NULL);
INSERT INTO dwell VALUES(49,1,1,24,1,21005000000000,21064980000000,430.0,1,50.071940054783780739,0.106365203857421875,49.581166666666668164,2,0,1050264,NULL);
CREATE TABLE sample (  -- raw counts as the board sent them; view sample_dps converts
  dwell_id        INTEGER NOT NULL REFERENCES dwell(id),  -- the dwell it was taken in
  seq             INTEGER NOT NULL CHECK (seq >= 0),  -- place in the board's stream, from 0; a hole is a lost sample
  t_ns            INTEGER NOT NULL,  -- when the board took it, by a fit of its counter to our clock
  gyro_x_lsb      INTEGER CHECK (gyro_x_lsb BETWEEN -32768 AND 32767),  -- X, roll; NULL: axis not measured
  gyro_y_lsb      INTEGER CHECK (gyro_y_lsb BETWEEN -32768 AND 32767),  -- Y, pitch
  gyro_z_lsb      INTEGER CHECK (gyro_z_lsb BETWEEN -32768 AND 32767),  -- Z, yaw
  temperature_raw INTEGER CHECK (temperature_raw BETWEEN -32768 AND 32767),  -- the board's sensor, degC * 256; NULL: not in the frame
  counter         INTEGER CHECK (counter >= 0),  -- frame counter where it is not counter_first + seq: the board restarted
  PRIMARY KEY (dwell_id, seq)
) STRICT, WITHOUT ROWID;
INSERT INTO sample VALUES(1,0,3370000000000,16,-4,28,-2432,NULL);
INSERT INTO sample VALUES(1,1,3370020000000,11,-11,20,-2432,NULL);
INSERT INTO sample VALUES(3,0,4210000000000,9,-14,17,-1792,NULL);
INSERT INTO sample VALUES(3,1,4210020000000,15,-15,14,-1792,NULL);
INSERT INTO sample VALUES(5,0,4845000000000,0,-14,22,-1280,NULL);
INSERT INTO sample VALUES(5,1,4845020000000,20,-7,15,-1280,NULL);
INSERT INTO sample VALUES(7,0,5680000000000,12,-11,23,-512,NULL);
INSERT INTO sample VALUES(7,1,5680020000000,5,-7,22,-512,NULL);
INSERT INTO sample VALUES(9,0,6305000000000,13,-8,17,-128,NULL);
INSERT INTO sample VALUES(9,1,6305020000000,17,-4,18,-128,NULL);
INSERT INTO sample VALUES(11,0,7150000000000,9,-2,10,768,NULL);
INSERT INTO sample VALUES(11,1,7150020000000,10,-12,25,768,NULL);
INSERT INTO sample VALUES(13,0,7785000000000,15,-4,21,1280,NULL);
INSERT INTO sample VALUES(13,1,7785020000000,21,2,18,1280,NULL);
INSERT INTO sample VALUES(15,0,8620000000000,19,-19,9,2048,NULL);
INSERT INTO sample VALUES(15,1,8620020000000,16,-8,12,2048,NULL);
INSERT INTO sample VALUES(17,0,9245000000000,10,-14,14,2432,NULL);
INSERT INTO sample VALUES(17,1,9245020000000,16,-7,8,2432,NULL);
INSERT INTO sample VALUES(19,0,10090000000000,11,-9,23,3328,NULL);
INSERT INTO sample VALUES(19,1,10090020000000,6,-6,15,3328,NULL);
INSERT INTO sample VALUES(21,0,10725000000000,12,-11,26,3840,NULL);
INSERT INTO sample VALUES(21,1,10725020000000,16,-5,18,3840,NULL);
INSERT INTO sample VALUES(23,0,11560000000000,10,0,30,4608,NULL);
INSERT INTO sample VALUES(23,1,11560020000000,14,-12,19,4608,NULL);
INSERT INTO sample VALUES(25,0,12185000000000,5,-15,21,4992,NULL);
INSERT INTO sample VALUES(25,1,12185020000000,21,-13,22,4992,NULL);
INSERT INTO sample VALUES(27,0,13030000000000,19,-16,18,5888,NULL);
INSERT INTO sample VALUES(27,1,13030020000000,15,-14,22,5888,NULL);
INSERT INTO sample VALUES(29,0,13665000000000,11,-15,20,6400,NULL);
INSERT INTO sample VALUES(29,1,13665020000000,6,-19,17,6400,NULL);
INSERT INTO sample VALUES(31,0,14500000000000,16,-4,16,7168,NULL);
INSERT INTO sample VALUES(31,1,14500020000000,9,-4,17,7168,NULL);
INSERT INTO sample VALUES(33,0,15125000000000,8,-12,12,7552,NULL);
INSERT INTO sample VALUES(33,1,15125020000000,5,-8,7,7552,NULL);
INSERT INTO sample VALUES(35,0,15970000000000,11,-7,5,8448,NULL);
INSERT INTO sample VALUES(35,1,15970020000000,10,-12,15,8448,NULL);
INSERT INTO sample VALUES(37,0,16605000000000,20,-18,18,8960,NULL);
INSERT INTO sample VALUES(37,1,16605020000000,7,-6,12,8960,NULL);
INSERT INTO sample VALUES(39,0,17440000000000,12,-1,20,9728,NULL);
INSERT INTO sample VALUES(39,1,17440020000000,17,-10,28,9728,NULL);
INSERT INTO sample VALUES(41,0,18065000000000,20,-10,15,10112,NULL);
INSERT INTO sample VALUES(41,1,18065020000000,8,-7,21,10112,NULL);
INSERT INTO sample VALUES(43,0,18910000000000,12,3,20,11008,NULL);
INSERT INTO sample VALUES(43,1,18910020000000,23,-16,22,11008,NULL);
INSERT INTO sample VALUES(45,0,19545000000000,21,-6,17,11520,NULL);
INSERT INTO sample VALUES(45,1,19545020000000,18,-16,25,11520,NULL);
INSERT INTO sample VALUES(47,0,20380000000000,9,-8,24,12288,NULL);
INSERT INTO sample VALUES(47,1,20380020000000,20,-13,17,12288,NULL);
INSERT INTO sample VALUES(49,0,21005000000000,8,-16,17,12672,NULL);
INSERT INTO sample VALUES(49,1,21005020000000,16,-12,17,12672,NULL);
CREATE TABLE monitor (  -- the slow stream: means over an interval, the whole campaign, ramps included
  board_id        INTEGER NOT NULL REFERENCES board(id),  -- which board
  t_ns            INTEGER NOT NULL,  -- centre of the interval
  setpoint_c      REAL CHECK (setpoint_c BETWEEN -273.15 AND 1000),  -- what the chamber said it controls to
  chamber_c       REAL CHECK (chamber_c BETWEEN -273.15 AND 1000),  -- mean air temperature
  board_c         REAL CHECK (board_c BETWEEN -273.15 AND 1000),  -- mean of the board's own sensor
  gyro_x_mean_lsb REAL CHECK (abs(gyro_x_mean_lsb) <= 32768),  -- mean raw count, X
  gyro_y_mean_lsb REAL CHECK (abs(gyro_y_mean_lsb) <= 32768),  -- mean raw count, Y
  gyro_z_mean_lsb REAL CHECK (abs(gyro_z_mean_lsb) <= 32768),  -- mean raw count, Z
  frames          INTEGER NOT NULL CHECK (frames >= 0),  -- frames the means are over
  frames_missing  INTEGER NOT NULL CHECK (frames_missing >= 0),  -- sent by the board, never received
  PRIMARY KEY (board_id, t_ns)
) STRICT, WITHOUT ROWID;
INSERT INTO monitor VALUES(1,2500000000,25.0,22.977380752563476562,23.0,13.436293436293436087,-9.841698841698841349,17.166023166023165913,259,0);
INSERT INTO monitor VALUES(1,7500000000,21.0,22.931170463562011718,23.0,13.444000000000000838,-9.7279999999999997584,17.036000000000001364,250,0);
INSERT INTO monitor VALUES(1,12500000000,21.0,22.883926391601562499,23.0,13.208000000000000185,-10.092000000000000525,16.615999999999999658,250,0);
INSERT INTO monitor VALUES(1,17500000000,21.0,22.836528778076171874,23.0,13.560000000000000496,-10.448000000000000397,16.896000000000000795,250,0);
INSERT INTO monitor VALUES(1,22500000000,21.0,22.788916587829589842,23.0,13.108000000000000539,-10.339999999999999857,17.344000000000001193,250,0);
CREATE TABLE event (  -- the journal: every transition, outage, refusal
  id          INTEGER PRIMARY KEY,
  campaign_id INTEGER NOT NULL REFERENCES campaign(id),  -- in which campaign
  t_ns        INTEGER NOT NULL,  -- campaign time
  utc_ns      INTEGER NOT NULL,  -- UTC as the machine had it, for the reader only
  severity    TEXT NOT NULL CHECK (severity IN ('info', 'warning', 'error')),  -- how bad
  kind        TEXT NOT NULL CHECK (kind <> ''),  -- one word a kind: transition, chamber_lost
  text        TEXT NOT NULL  -- a sentence
) STRICT;
INSERT INTO event VALUES(1,1,0,1767225600360000000,'info','transition','preflight -> ramping at -10.0 degC (point 1 of 25)');
INSERT INTO event VALUES(2,1,2800000000000,1767228400360000000,'info','transition','ramping -> soaking at -10.0 degC (point 1 of 25)');
INSERT INTO event VALUES(3,1,3370000000000,1767228970360000000,'info','transition','soaking -> logging at -10.0 degC (point 1 of 25)');
INSERT INTO event VALUES(4,1,3430000000000,1767229030360000000,'info','transition','logging -> ramping at -7.0 degC (point 2 of 25)');
INSERT INTO event VALUES(5,1,3665000000000,1767229265360000000,'info','transition','ramping -> soaking at -7.0 degC (point 2 of 25)');
CREATE TABLE analysis (  -- one pass of filter and models over a campaign's accepted dwells
  id               INTEGER PRIMARY KEY,
  campaign_id      INTEGER NOT NULL REFERENCES campaign(id),  -- what was analysed
  settings_json    TEXT NOT NULL CHECK (json_valid(settings_json)),  -- wavelet, mode, level, rule
  software_version TEXT NOT NULL,  -- of gyrocal
  UNIQUE (campaign_id, settings_json, software_version)
) STRICT;
INSERT INTO analysis VALUES(1,1,'{"wavelet":"db4","mode":"symmetric","level":5,"rule":"approximation"}','0.1.0');
CREATE TABLE dwell_drift (  -- zero drift of one accepted dwell and axis, before and after the filter
  analysis_id        INTEGER NOT NULL REFERENCES analysis(id) ON DELETE CASCADE,  -- with which settings
  dwell_id           INTEGER NOT NULL REFERENCES dwell(id),  -- of which samples
  axis               TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  raw_mean_dps       REAL NOT NULL CHECK (abs(raw_mean_dps) < 1e6),  -- mean of the samples
  raw_sd_dps         REAL NOT NULL CHECK (raw_sd_dps BETWEEN 0 AND 1e6),  -- their standard deviation
  filtered_mean_dps  REAL NOT NULL CHECK (abs(filtered_mean_dps) < 1e6),  -- mean after the filter: the zero drift
  filtered_sd_dps    REAL NOT NULL CHECK (filtered_sd_dps BETWEEN 0 AND 1e6),  -- standard deviation after the filter
  standard_error_dps REAL CHECK (standard_error_dps BETWEEN 0 AND 1e6),  -- of the zero drift, from its own autocorrelated noise
  PRIMARY KEY (analysis_id, dwell_id, axis)
) STRICT, WITHOUT ROWID;
INSERT INTO dwell_drift VALUES(1,1,'z',4.3880548829701826463,1.308462727715228091,4.387518759456598083,0.25148016613360779647,0.023841200549425928256);
INSERT INTO dwell_drift VALUES(1,3,'z',4.384100080710300773,1.3378215712723333652,4.383834161612342406,0.22564680637702214105,0.024409242992014749257);
INSERT INTO dwell_drift VALUES(1,5,'z',4.3185633575464583699,1.329311231114979952,4.3184247591025695101,0.24015513347056188786,0.024267335817086607696);
INSERT INTO dwell_drift VALUES(1,7,'z',4.3497175141243396012,1.3141748585175900831,4.3493967313990049561,0.22774091906402368912,0.023993730933145409472);
INSERT INTO dwell_drift VALUES(1,9,'z',4.2573849878935048351,1.3118831508703368005,4.2581768381854825378,0.2332060469363390065,0.024022313872764988751);
INSERT INTO dwell_drift VALUES(1,11,'z',4.2711057304278021717,1.3574368259131732727,4.2722820895484989733,0.28093362912757408045,0.024851400659682259391);
INSERT INTO dwell_drift VALUES(1,13,'z',4.2541565778854302237,1.3281743772086789245,4.2527226150757115874,0.18127847345666994738,0.024197090829080038221);
INSERT INTO dwell_drift VALUES(1,15,'z',4.2143664245359708786,1.2995597569996832909,4.2146707002820091858,0.22965789802191610702,0.023661145301336141549);
INSERT INTO dwell_drift VALUES(1,17,'z',4.1983050847458063259,1.3162933001643499775,4.1995582478426776162,0.20620284632531674096,0.023884360035726193149);
INSERT INTO dwell_drift VALUES(1,19,'z',4.1708635996772018827,1.288054596022393694,4.1705139227121232892,0.22883938523718005964,0.023468466594668467573);
INSERT INTO dwell_drift VALUES(1,21,'z',4.1946731234867282722,1.3351154613994538067,4.1942571409625433176,0.24083057388147827149,0.024420533864484793989);
INSERT INTO dwell_drift VALUES(1,23,'z',4.1544794188862388395,1.3267876582106585825,4.1547345877514034739,0.22992820729576080029,0.024150748167680268635);
INSERT INTO dwell_drift VALUES(1,25,'z',4.0899919289750235051,1.3009931195475903376,4.0897992699226675128,0.23005088233643619655,0.023734245905834318313);
INSERT INTO dwell_drift VALUES(1,27,'z',4.1345439870864044706,1.30096330727559506,4.1342809057574338993,0.2415966066297262349,0.023769089812135660993);
INSERT INTO dwell_drift VALUES(1,29,'z',4.0807102502018208767,1.3026575185184114946,4.0804300364930270461,0.20697286648249924034,0.023662803595513603321);
INSERT INTO dwell_drift VALUES(1,31,'z',4.0824858757062534309,1.3118714209000101877,4.0841374295777850278,0.21253198809409301617,0.024011779401993033067);
INSERT INTO dwell_drift VALUES(1,33,'z',4.1197740112994738481,1.3447466061728079456,4.1192501011450222137,0.24886467329205641529,0.024500772628771899652);
INSERT INTO dwell_drift VALUES(1,35,'z',4.1082324455206116198,1.3152495376991162334,4.1069426489029217108,0.22881962034522401738,0.02395391231961064779);
INSERT INTO dwell_drift VALUES(1,37,'z',4.0911218724778395383,1.3111037726648040457,4.0898808310329055615,0.22818351077177806418,0.023906561894650662364);
INSERT INTO dwell_drift VALUES(1,39,'z',4.0669087974173079302,1.2923451227736164614,4.0674551803484835232,0.23042520820838013895,0.023675307930795776861);
INSERT INTO dwell_drift VALUES(1,41,'z',4.0733656174334589294,1.3296863987583771304,4.073517082671611611,0.27117429813700616447,0.098603405378750383358);
INSERT INTO dwell_drift VALUES(1,43,'z',4.0895076674738062294,1.3230057235085004307,4.089302828543861068,0.25784361284029350125,0.024207369153219283897);
INSERT INTO dwell_drift VALUES(1,45,'z',4.0361581920904443521,1.2773233465149760323,4.0352112541798135225,0.20375488532481622616,0.023230290902480816433);
INSERT INTO dwell_drift VALUES(1,47,'z',4.0420500403551660184,1.3186766126747073712,4.0433625943343969311,0.21827556264795039409,0.024018055633859048542);
INSERT INTO dwell_drift VALUES(1,49,'z',4.0554479418886613117,1.288492937631543489,4.0549640820121171103,0.2350322756141981495,0.023654150528378051904);
CREATE TABLE model (  -- zero drift over temperature for one board and axis, by one method
  id                   INTEGER PRIMARY KEY,
  analysis_id          INTEGER NOT NULL REFERENCES analysis(id) ON DELETE CASCADE,  -- settings and version
  board_id             INTEGER NOT NULL REFERENCES board(id),  -- whose drift
  axis                 TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  method               TEXT NOT NULL CHECK (method <> ''),  -- gm11, improved_gm11, least_squares, ...
  parameters_json      TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- all that is needed to evaluate it
  rmse_dps             REAL NOT NULL CHECK (rmse_dps BETWEEN 0 AND 1e6),  -- fitted against measured, divided by n
  rmse_n_minus_1_dps   REAL NOT NULL CHECK (rmse_n_minus_1_dps BETWEEN 0 AND 1e6),  -- divided by n - 1
  mae_dps              REAL NOT NULL CHECK (mae_dps BETWEEN 0 AND 1e6),  -- mean absolute error
  max_dps              REAL NOT NULL CHECK (max_dps BETWEEN 0 AND 1e6),  -- largest absolute error
  loocv_rmse_dps       REAL CHECK (loocv_rmse_dps BETWEEN 0 AND 1e6),  -- leave-one-out: the honest one
  recommended          INTEGER NOT NULL CHECK (recommended IN (0, 1)),  -- 1: the one to use
  reason               TEXT NOT NULL,  -- why recommended, or empty
  dwells_sha256        TEXT NOT NULL,  -- over the raw samples of the dwells used
  UNIQUE (analysis_id, board_id, axis, method)
) STRICT;
INSERT INTO model VALUES(19,1,1,'z','gm11','{"a":0.0032446727448098302,"b":4.338171225071292,"first_index":1.0,"first_dps":4.387518759456598,"translation_dps":0.0,"setpoints_c":[-10.0,-7.0,-5.0,-2.0,0.0,3.0,5.0,8.0,10.0,13.0,15.0,18.0,20.0,23.0,25.0,28.0,30.0,33.0,35.0,38.0,40.0,43.0,45.0,48.0,50.0]}',0.033346052551073403213,0.034033672369234636845,0.025131190269556319405,0.07576858887672432985,0.041093422261124362693,0,'','05f7c0e7c1308bb6268f63cdc05b5d68418f23ba7cb0e0ac8c96c30dc50ff9ee');
INSERT INTO model VALUES(21,1,1,'z','least_squares','{"centre":13.0,"scale":7.359800721939872,"coefficients":[4.136466858918964,-0.09445881091863474,0.03387305524495479,-0.004856950624681552],"setpoints_c":[-10.0,-7.0,-5.0,-2.0,0.0,3.0,5.0,8.0,10.0,13.0,15.0,18.0,20.0,23.0,25.0,28.0,30.0,33.0,35.0,38.0,40.0,43.0,45.0,48.0,50.0]}',0.020677104204224579925,0.021103481107794596488,0.017181678328610595907,0.046667588996296416326,0.023967056150206507425,1,'least_squares predicts setpoints it has not seen best: leave-one-out error 0.0240 deg/s against polynomial_2 0.0244, smoothing_spline 0.0246, polynomial_3 0.0250, polynomial_4 0.0257, polynomial_5 0.0275, improved_gm11 0.0295, polynomial_1 0.0397, gm11 0.0411. With a block of three left out smoothing_spline leads (0.0235 against 0.0257).','05f7c0e7c1308bb6268f63cdc05b5d68418f23ba7cb0e0ac8c96c30dc50ff9ee');
CREATE TABLE model_dwell (  -- provenance: the dwells a model was fitted to
  model_id INTEGER NOT NULL REFERENCES model(id) ON DELETE CASCADE,  -- the model
  position INTEGER NOT NULL CHECK (position >= 0),  -- order in which they were used
  dwell_id INTEGER NOT NULL REFERENCES dwell(id),  -- the dwell
  PRIMARY KEY (model_id, position),
  UNIQUE (model_id, dwell_id)
) STRICT, WITHOUT ROWID;
INSERT INTO model_dwell VALUES(19,0,1);
INSERT INTO model_dwell VALUES(21,0,1);
INSERT INTO model_dwell VALUES(19,1,3);
INSERT INTO model_dwell VALUES(21,1,3);
INSERT INTO model_dwell VALUES(19,2,5);
INSERT INTO model_dwell VALUES(21,2,5);
INSERT INTO model_dwell VALUES(19,3,7);
INSERT INTO model_dwell VALUES(21,3,7);
INSERT INTO model_dwell VALUES(19,4,9);
INSERT INTO model_dwell VALUES(21,4,9);
INSERT INTO model_dwell VALUES(19,5,11);
INSERT INTO model_dwell VALUES(21,5,11);
INSERT INTO model_dwell VALUES(19,6,13);
INSERT INTO model_dwell VALUES(21,6,13);
INSERT INTO model_dwell VALUES(19,7,15);
INSERT INTO model_dwell VALUES(21,7,15);
INSERT INTO model_dwell VALUES(19,8,17);
INSERT INTO model_dwell VALUES(21,8,17);
INSERT INTO model_dwell VALUES(19,9,19);
INSERT INTO model_dwell VALUES(21,9,19);
INSERT INTO model_dwell VALUES(19,10,21);
INSERT INTO model_dwell VALUES(21,10,21);
INSERT INTO model_dwell VALUES(19,11,23);
INSERT INTO model_dwell VALUES(21,11,23);
INSERT INTO model_dwell VALUES(19,12,25);
INSERT INTO model_dwell VALUES(21,12,25);
INSERT INTO model_dwell VALUES(19,13,27);
INSERT INTO model_dwell VALUES(21,13,27);
INSERT INTO model_dwell VALUES(19,14,29);
INSERT INTO model_dwell VALUES(21,14,29);
INSERT INTO model_dwell VALUES(19,15,31);
INSERT INTO model_dwell VALUES(21,15,31);
INSERT INTO model_dwell VALUES(19,16,33);
INSERT INTO model_dwell VALUES(21,16,33);
INSERT INTO model_dwell VALUES(19,17,35);
INSERT INTO model_dwell VALUES(21,17,35);
INSERT INTO model_dwell VALUES(19,18,37);
INSERT INTO model_dwell VALUES(21,18,37);
INSERT INTO model_dwell VALUES(19,19,39);
INSERT INTO model_dwell VALUES(21,19,39);
INSERT INTO model_dwell VALUES(19,20,41);
INSERT INTO model_dwell VALUES(21,20,41);
INSERT INTO model_dwell VALUES(19,21,43);
INSERT INTO model_dwell VALUES(21,21,43);
INSERT INTO model_dwell VALUES(19,22,45);
INSERT INTO model_dwell VALUES(21,22,45);
INSERT INTO model_dwell VALUES(19,23,47);
INSERT INTO model_dwell VALUES(21,23,47);
INSERT INTO model_dwell VALUES(19,24,49);
INSERT INTO model_dwell VALUES(21,24,49);
CREATE TABLE model_point (  -- the model against what it was fitted to
  model_id      INTEGER NOT NULL REFERENCES model(id) ON DELETE CASCADE,  -- the model
  position      INTEGER NOT NULL CHECK (position >= 0),  -- order of the points
  temperature_c REAL NOT NULL CHECK (temperature_c BETWEEN -273.15 AND 1000),  -- where
  measured_dps  REAL NOT NULL CHECK (abs(measured_dps) < 1e6),  -- zero drift of the dwell
  fitted_dps    REAL NOT NULL CHECK (abs(fitted_dps) < 1e6),  -- what the model says there
  PRIMARY KEY (model_id, position)
) STRICT, WITHOUT ROWID;
INSERT INTO model_point VALUES(19,0,-10.0,4.387518759456598083,4.387518759456598083);
INSERT INTO model_point VALUES(19,1,-7.0,4.383834161612342406,4.3169278660924161883);
INSERT INTO model_point VALUES(19,2,-5.0,4.3184247591025695101,4.3029435474415791418);
INSERT INTO model_point VALUES(19,3,-2.0,4.3493967313990049561,4.2890045297951111535);
INSERT INTO model_point VALUES(19,4,0.0,4.2581768381854825378,4.2751106664042843874);
INSERT INTO model_point VALUES(19,5,3.0,4.2722820895484989733,4.261261810995751631);
INSERT INTO model_point VALUES(19,6,5.0,4.2527226150757115874,4.2474578177699910952);
INSERT INTO model_point VALUES(19,7,8.0,4.2146707002820091858,4.2336985413998178273);
INSERT INTO model_point VALUES(19,8,10.0,4.1995582478426776162,4.2199838370287849897);
INSERT INTO model_point VALUES(19,9,13.0,4.1705139227121232892,4.206313560269720142);
INSERT INTO model_point VALUES(19,10,15.0,4.1942571409625433176,4.1926875672031655994);
INSERT INTO model_point VALUES(19,11,18.0,4.1547345877514034739,4.179105714375928926);
INSERT INTO model_point VALUES(19,12,20.0,4.0897992699226675128,4.1655678587993918426);
INSERT INTO model_point VALUES(19,13,23.0,4.1342809057574338993,4.1520738579483165153);
INSERT INTO model_point VALUES(19,14,25.0,4.0804300364930270461,4.1386235697590265658);
INSERT INTO model_point VALUES(19,15,28.0,4.0841374295777850278,4.1252168526280641458);
INSERT INTO model_point VALUES(19,16,30.0,4.1192501011450222137,4.1118535654107688515);
INSERT INTO model_point VALUES(19,17,33.0,4.1069426489029217108,4.0985335674196221589);
INSERT INTO model_point VALUES(19,18,35.0,4.0898808310329055615,4.085256718422883182);
INSERT INTO model_point VALUES(19,19,38.0,4.0674551803484835232,4.0720228786430681111);
INSERT INTO model_point VALUES(19,20,40.0,4.073517082671611611,4.0588319087554793895);
INSERT INTO model_point VALUES(19,21,43.0,4.089302828543861068,4.0456836698868272605);
INSERT INTO model_point VALUES(19,22,45.0,4.0352112541798135225,4.0325780236135528866);
INSERT INTO model_point VALUES(19,23,48.0,4.0433625943343969311,4.0195148319606204267);
INSERT INTO model_point VALUES(19,24,50.0,4.0549640820121171103,4.0064939573999538424);
INSERT INTO model_point VALUES(21,0,-10.0,4.387518759456598083,4.4015829450770409536);
INSERT INTO model_point VALUES(21,1,-7.0,4.383834161612342406,4.3695287230161499181);
INSERT INTO model_point VALUES(21,2,-5.0,4.3184247591025695101,4.3395292972614338822);
INSERT INTO model_point VALUES(21,3,-2.0,4.3493967313990049561,4.3115115679145521454);
INSERT INTO model_point VALUES(21,4,0.0,4.2581768381854825378,4.2854024350771631191);
INSERT INTO model_point VALUES(21,5,3.0,4.2722820895484989733,4.261128798850927879);
INSERT INTO model_point VALUES(21,6,5.0,4.2527226150757115874,4.2386175593375048364);
INSERT INTO model_point VALUES(21,7,8.0,4.2146707002820091858,4.2177956166385541791);
INSERT INTO model_point VALUES(21,8,10.0,4.1995582478426776162,4.1985898708557352065);
INSERT INTO model_point VALUES(21,9,13.0,4.1705139227121232892,4.1809272220907072181);
INSERT INTO model_point VALUES(21,10,15.0,4.1942571409625433176,4.1647345704451295134);
INSERT INTO model_point VALUES(21,11,18.0,4.1547345877514034739,4.1499388160206613918);
INSERT INTO model_point VALUES(21,12,20.0,4.0897992699226675128,4.1364668589189639291);
INSERT INTO model_point VALUES(21,13,23.0,4.1342809057574338993,4.1242455992416955368);
INSERT INTO model_point VALUES(21,14,25.0,4.0804300364930270461,4.113201937090514626);
INSERT INTO model_point VALUES(21,15,28.0,4.0841374295777850278,4.1032627725670831608);
INSERT INTO model_point VALUES(21,16,30.0,4.1192501011450222137,4.0943550057730586644);
INSERT INTO model_point VALUES(21,17,33.0,4.1069426489029217108,4.0864055368101013243);
INSERT INTO model_point VALUES(21,18,35.0,4.0898808310329055615,4.0793412657798704401);
INSERT INTO model_point VALUES(21,19,38.0,4.0674551803484835232,4.0730890927840261994);
INSERT INTO model_point VALUES(21,20,40.0,4.073517082671611611,4.0675759179242270136);
INSERT INTO model_point VALUES(21,21,43.0,4.089302828543861068,4.0627286413021330702);
INSERT INTO model_point VALUES(21,22,45.0,4.0352112541798135225,4.0584741630194036687);
INSERT INTO model_point VALUES(21,23,48.0,4.0433625943343969311,4.0547393831776989969);
INSERT INTO model_point VALUES(21,24,50.0,4.0549640820121171103,4.051451201878677466);
CREATE TABLE rig_model (  -- what the simulation contains: a baseline and the effects in rig_effect
  id               INTEGER PRIMARY KEY,
  name             TEXT NOT NULL CHECK (name <> ''),  -- what people call it
  sha256           TEXT NOT NULL UNIQUE,  -- of model_json: the same model is stored once
  parent_id        INTEGER REFERENCES rig_model(id),  -- the model it was made from; NULL: the first
  baseline_json    TEXT NOT NULL CHECK (json_valid(baseline_json)),  -- bias, noise, lags
  model_json       TEXT NOT NULL CHECK (json_valid(model_json)),  -- the whole model as its file holds it
  software_version TEXT NOT NULL  -- of gyrocal
) STRICT;
CREATE TABLE rig_effect (  -- one effect of a rig model
  rig_model_id    INTEGER NOT NULL REFERENCES rig_model(id) ON DELETE CASCADE,  -- the model
  position        INTEGER NOT NULL CHECK (position >= 0),  -- order in the model
  effect          TEXT NOT NULL CHECK (effect <> ''),  -- name in the catalogue: thermal_hysteresis
  law             TEXT NOT NULL,  -- which of its laws; empty if it has one
  parameters_json TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- name to value, units as in the catalogue
  PRIMARY KEY (rig_model_id, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE diagnosis (  -- one comparison of a measured session with a rig model
  id                  INTEGER PRIMARY KEY,
  board_id            INTEGER REFERENCES board(id),  -- whose session; NULL: a session directory
  axis                TEXT NOT NULL CHECK (axis IN ('x', 'y', 'z')),  -- gyro axis
  source              TEXT NOT NULL,  -- the session as a person names it
  rig_model_before_id INTEGER NOT NULL REFERENCES rig_model(id),  -- what was compared
  rig_model_after_id  INTEGER NOT NULL REFERENCES rig_model(id),  -- with all findings added
  verdict             TEXT NOT NULL CHECK (verdict IN ('consistent', 'explained', 'unexplained', 'confounded')),  -- the outcome
  gap_before          REAL NOT NULL CHECK (gap_before BETWEEN 0 AND 1e12),  -- error bars beyond chance on kept-out data, before
  gap_after           REAL NOT NULL CHECK (gap_after BETWEEN 0 AND 1e12),  -- the same with all findings added
  report_json         TEXT NOT NULL CHECK (json_valid(report_json)),  -- gyrocal-diagnosis/1, whole
  software_version    TEXT NOT NULL  -- of gyrocal
) STRICT;
CREATE TABLE finding (  -- one effect a diagnosis named
  diagnosis_id         INTEGER NOT NULL REFERENCES diagnosis(id) ON DELETE CASCADE,  -- in which diagnosis
  position             INTEGER NOT NULL CHECK (position >= 0),  -- order of finding
  effect               TEXT NOT NULL CHECK (effect <> ''),  -- name in the catalogue, or unknown
  amplitude            REAL NOT NULL CHECK (abs(amplitude) < 1e12),  -- its size
  unit                 TEXT NOT NULL,  -- unit of amplitude
  standard_error       REAL CHECK (standard_error BETWEEN 0 AND 1e12),  -- of amplitude
  parameters_json      TEXT NOT NULL CHECK (json_valid(parameters_json)),  -- the other parameters
  evidence_nats        REAL CHECK (abs(evidence_nats) < 1e12),  -- log likelihood gained on held-out data
  lead_nats            REAL CHECK (abs(lead_nats) < 1e12),  -- over the next best effect
  confounded_with_json TEXT NOT NULL CHECK (json_valid(confounded_with_json)),  -- names that explain it as well
  tell_apart           TEXT NOT NULL,  -- the observation that would decide, or empty
  description          TEXT NOT NULL,  -- a sentence
  gap_before           REAL CHECK (gap_before BETWEEN 0 AND 1e12),  -- before this effect was added
  gap_after            REAL CHECK (gap_after BETWEEN 0 AND 1e12),  -- after it was added
  PRIMARY KEY (diagnosis_id, position)
) STRICT, WITHOUT ROWID;
CREATE UNIQUE INDEX dwell_accepted ON dwell (board_id, ordinal) WHERE reject_reason IS NULL;
CREATE INDEX dwell_of_campaign ON dwell (campaign_id, ordinal);
CREATE INDEX event_of_campaign ON event (campaign_id, t_ns);
CREATE INDEX dwell_drift_of_dwell ON dwell_drift (dwell_id);
CREATE UNIQUE INDEX model_recommended ON model (analysis_id, board_id, axis) WHERE recommended = 1;
CREATE INDEX model_of_board ON model (board_id, axis);
CREATE INDEX model_dwell_of_dwell ON model_dwell (dwell_id);
CREATE INDEX rig_model_of_parent ON rig_model (parent_id);
CREATE INDEX diagnosis_of_board ON diagnosis (board_id, axis);
CREATE INDEX diagnosis_of_model_before ON diagnosis (rig_model_before_id);
CREATE INDEX diagnosis_of_model_after ON diagnosis (rig_model_after_id);
CREATE VIEW campaign_progress AS  -- where each campaign stands
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  campaign.state,  -- of the state machine
  datetime(nullif(campaign.utc_start_ns, 0) / 1000000000, 'unixepoch') AS utc_start,  -- when it began; NULL: unknown
  (SELECT count(*) FROM board WHERE board.campaign_id = campaign.id) AS boards,  -- taking part
  (SELECT count(*) FROM setpoint WHERE setpoint.campaign_id = campaign.id) AS setpoints,  -- planned
  (SELECT count(DISTINCT dwell.ordinal) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NULL) AS setpoints_logged,  -- with an accepted dwell of any board
  (SELECT count(*) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NULL) AS dwells_accepted,  -- one a board and setpoint
  (SELECT count(*) FROM dwell WHERE dwell.campaign_id = campaign.id AND dwell.reject_reason IS NOT NULL) AS dwells_rejected,  -- kept, with their reason
  (SELECT coalesce(sum(dwell.samples), 0) FROM dwell WHERE dwell.campaign_id = campaign.id) AS samples,  -- stored
  (SELECT coalesce(sum(dwell.frames_missing), 0) FROM dwell WHERE dwell.campaign_id = campaign.id) AS frames_missing,  -- lost while logging
  max((SELECT coalesce(max(event.t_ns), 0) FROM event WHERE event.campaign_id = campaign.id),
      (SELECT coalesce(max(dwell.t_end_ns), 0) FROM dwell WHERE dwell.campaign_id = campaign.id)) / 1e9 AS t_last_s  -- latest event or dwell, since campaign start
FROM campaign
;
CREATE VIEW gap_history AS  -- how the gap between simulation and measurement shrank, effect by effect
SELECT
  diagnosis.id AS diagnosis_id,  -- diagnosis.id
  diagnosis.source,  -- the session as a person names it
  diagnosis.axis,  -- gyro axis
  model_before.name AS rig_model_before,  -- what was compared
  model_after.name AS rig_model_after,  -- with all findings added
  finding.position AS step,  -- order of finding; NULL: nothing was missing
  finding.effect AS effect_added,  -- name in the catalogue, or unknown
  CASE WHEN finding.position IS NULL THEN diagnosis.gap_before ELSE finding.gap_before END AS gap_before,  -- error bars beyond chance, before the step
  CASE WHEN finding.position IS NULL THEN diagnosis.gap_after ELSE finding.gap_after END AS gap_after  -- after the step
FROM diagnosis
JOIN rig_model AS model_before ON model_before.id = diagnosis.rig_model_before_id
JOIN rig_model AS model_after ON model_after.id = diagnosis.rig_model_after_id
LEFT JOIN finding ON finding.diagnosis_id = diagnosis.id
ORDER BY diagnosis.id, finding.position
;
CREATE VIEW model_comparison AS  -- the paper's Table 2 for every board and axis, by the latest analysis
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  board.name AS board,  -- board's name
  model.axis,  -- gyro axis
  model.method,  -- gm11, improved_gm11, least_squares, ...
  model.rmse_dps,  -- fitted against measured, divided by n
  model.mae_dps,  -- mean absolute error
  model.loocv_rmse_dps,  -- leave-one-out: the honest one
  model.rmse_n_minus_1_dps,  -- divided by n - 1, as parts of the paper do
  model.max_dps,  -- largest absolute error
  model.recommended  -- 1: the one to use
FROM campaign
JOIN model ON model.analysis_id = (SELECT max(analysis.id) FROM analysis WHERE analysis.campaign_id = campaign.id)
JOIN board ON board.id = model.board_id
;
CREATE VIEW monitor_dps AS  -- the slow stream in degrees per second
SELECT
  board.campaign_id,  -- campaign.id
  board.name AS board,  -- board's name
  monitor.t_ns / 1e9 AS t_s,  -- centre of the interval, since campaign start
  monitor.setpoint_c,  -- what the chamber said it controls to
  monitor.chamber_c,  -- mean air temperature
  monitor.board_c,  -- mean of the board's own sensor
  monitor.gyro_x_mean_lsb / (board.lsb_per_dps_x + board.lsb_per_dps_per_k_x * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_x_dps,  -- mean rate, X
  monitor.gyro_y_mean_lsb / (board.lsb_per_dps_y + board.lsb_per_dps_per_k_y * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_y_dps,  -- mean rate, Y
  monitor.gyro_z_mean_lsb / (board.lsb_per_dps_z + board.lsb_per_dps_per_k_z * (coalesce(monitor.board_c, 20.0) - 20.0)) AS gyro_z_dps,  -- mean rate, Z
  monitor.frames,  -- frames the means are over
  monitor.frames_missing  -- sent by the board, never received
FROM monitor
JOIN board ON board.id = monitor.board_id
;
CREATE VIEW sample_dps AS  -- samples in degrees per second, with board, setpoint and time
SELECT
  dwell.campaign_id,  -- campaign.id
  board.name AS board,  -- board's name
  dwell.id AS dwell_id,  -- dwell.id
  setpoint.setpoint_c,  -- what the chamber was told
  dwell.reject_reason,  -- NULL: accepted
  sample.seq,  -- place in the dwell; a hole is a lost sample
  sample.t_ns / 1e9 AS t_s,  -- since campaign start
  sample.gyro_x_lsb / (board.lsb_per_dps_x + board.lsb_per_dps_per_k_x * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_x_dps,  -- X, roll
  sample.gyro_y_lsb / (board.lsb_per_dps_y + board.lsb_per_dps_per_k_y * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_y_dps,  -- Y, pitch
  sample.gyro_z_lsb / (board.lsb_per_dps_z + board.lsb_per_dps_per_k_z * (coalesce(sample.temperature_raw / 256.0, dwell.board_mean_c, 20.0) - 20.0)) AS gyro_z_dps,  -- Z, yaw
  sample.temperature_raw / 256.0 AS board_c  -- the board's own sensor
FROM sample
JOIN dwell ON dwell.id = sample.dwell_id
JOIN board ON board.id = dwell.board_id
JOIN setpoint ON setpoint.campaign_id = dwell.campaign_id AND setpoint.ordinal = dwell.ordinal
;
CREATE VIEW zero_drift AS  -- zero drift per board, axis and setpoint, by the campaign's latest analysis
SELECT
  campaign.id AS campaign_id,  -- campaign.id
  campaign.name AS campaign,  -- campaign's name
  board.name AS board,  -- board's name
  dwell_drift.axis,  -- gyro axis
  setpoint.ordinal,  -- order of visit
  setpoint.setpoint_c,  -- what the chamber was told
  dwell.chamber_mean_c,  -- air while logging
  dwell.board_mean_c,  -- the board's own sensor while logging
  dwell_drift.raw_mean_dps,  -- mean of the samples
  dwell_drift.raw_sd_dps,  -- their standard deviation
  dwell_drift.filtered_mean_dps,  -- mean after the filter: the zero drift
  dwell_drift.filtered_sd_dps,  -- standard deviation after the filter
  dwell_drift.standard_error_dps  -- of the zero drift
FROM campaign
JOIN dwell_drift ON dwell_drift.analysis_id = (SELECT max(analysis.id) FROM analysis WHERE analysis.campaign_id = campaign.id)
JOIN dwell ON dwell.id = dwell_drift.dwell_id
JOIN board ON board.id = dwell.board_id
JOIN setpoint ON setpoint.campaign_id = dwell.campaign_id AND setpoint.ordinal = dwell.ordinal
;
COMMIT;
PRAGMA application_id = 0x47595243;
PRAGMA user_version = 1;
